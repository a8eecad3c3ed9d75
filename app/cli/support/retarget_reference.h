#pragma once
#include <memory>
#include <string>

#include "app/cli/support/session.h"

namespace sinew {

class RetargetReference;

/// The prepared reference of a preset ("reference", "reference:athlete"). Preparing it cannot be stopped half way,
/// but nothing is open or written meanwhile: Ctrl-C ends the program there and then, with `cancelled` as its result.
/// @throws InputError for a model file: bodies are made from the undeformed reference.
std::shared_ptr<const RetargetReference> preparedReference(Session& session, const std::string& model_name,
                                                           const std::string& where, const Json& cancelled);

}  // namespace sinew
