#include "app/model/view_state.h"

namespace sinew {

void ViewState::setStage(Stage stage) {
  if (stage == stage_ && !explorer_ && !retargeting_) return;
  stage_ = stage;
  explorer_ = retargeting_ = false;
  emit stageChanged();
}

void ViewState::setExplorer(bool shown) {
  if (shown == explorer_) return;
  explorer_ = shown;
  if (shown) retargeting_ = false;
  emit stageChanged();
}

void ViewState::setRetargeting(bool shown) {
  if (shown == retargeting_) return;
  retargeting_ = shown;
  if (shown) explorer_ = false;
  emit stageChanged();
}

void ViewState::setLandmark(const std::string& name) {
  if (name == landmark_) return;
  landmark_ = name;
  emit landmarkChanged();
}

void ViewState::setMuscle(const std::string& name) {
  if (name == muscle_) return;
  muscle_ = name;
  emit muscleChanged();
}

void ViewState::setWindow(int slot, const DisplayWindow& window) {
  auto& current = windows_.at(std::size_t(slot));
  if (current == window) return;
  current = window;
  emit windowChanged(slot);
}

void ViewState::reset() {
  setStage(Stage::Images);
  setLandmark({});
  setMuscle({});
  for (int slot = 0; slot < int(windows_.size()); ++slot) setWindow(slot, {});
}

}  // namespace sinew
