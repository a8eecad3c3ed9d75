#pragma once
#include <memory>

#include "core/retarget/prepared/reference.h"
#include "tests/support/resources.h"

namespace sinew::test {

/// The reference with its pose set, made once in a process: a second.
inline const std::shared_ptr<const RetargetReference>& retargetReference() {
  static const auto reference = loadRetargetReference(resourceDir());
  return reference;
}

}  // namespace sinew::test
