#include "app/model/view_state.h"

namespace sinew {

void ViewState::setStage(Stage stage) {
  if (stage == stage_) return;
  stage_ = stage;
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

void ViewState::setWindow(int view, const DisplayWindow& window) {
  auto& current = windows_.at(std::size_t(view));
  if (current == window) return;
  current = window;
  emit windowChanged(view);
}

void ViewState::reset() {
  setStage(Stage::Images);
  setLandmark({});
  setMuscle({});
  for (int view = 0; view < 2; ++view) setWindow(view, {});
}

}  // namespace sinew
