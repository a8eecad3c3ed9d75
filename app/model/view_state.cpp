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

DisplayWindow ViewState::window(int slot) const {
  const auto found = windows_.find(slot);
  return found == windows_.end() ? DisplayWindow{} : found->second;
}

void ViewState::setWindow(int slot, const DisplayWindow& window) {
  if (this->window(slot) == window) return;
  windows_[slot] = window;
  emit windowChanged(slot);
}

void ViewState::reset() {
  setStage(Stage::Images);
  setLandmark({});
  setMuscle({});
  for (const auto& [slot, window] : windows_) setWindow(slot, {});
}

}  // namespace sinew
