#include <spdlog/spdlog.h>

#include <chrono>

#include "app/cli/support/session.h"
#include "core/io/foreign/foreign_json.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {

const Model& Session::reference() {
  if (!reference_) {
    const auto start = std::chrono::steady_clock::now();
    reference_ = std::make_shared<const Model>(loadReferenceModel(resourceDir()));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    spdlog::debug("reference model: {:.3f} s", seconds.count());
  }
  return *reference_;
}

std::shared_ptr<const RetargetReference> Session::retargeting() {
  if (!retargeting_) {
    const auto start = std::chrono::steady_clock::now();
    retargeting_ = loadRetargetReference(resourceDir());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    spdlog::debug("reference of retargeting: {:.3f} s", seconds.count());
  }
  return retargeting_;
}

Model Session::model(const std::string& name_or_file) {
  if (const auto preset = presetOf(name_or_file))
    return name_or_file == reference().name ? reference() : loadReferenceModel(resourceDir(), *preset);
  return loadModel(name_or_file, reference());
}

std::optional<ForeignModel> Session::foreignModel(const std::string& file) {
  if (presetOf(file) || !isForeignModelFile(file)) return std::nullopt;
  ForeignModel model = loadForeignModel(file);
  warn(model.warnings);
  return model;
}

}  // namespace sinew
