#pragma once
#include <QObject>
#include <map>
#include <optional>
#include <string>

#include "clinical/case/case.h"

namespace sinew {

/// How one radiograph is shown. nullopt = the file's own window.
struct DisplayWindow {
  std::optional<double> center, width;
  bool invert = false;
  friend bool operator==(const DisplayWindow&, const DisplayWindow&) = default;
};

/// What the person looks at: never part of the case, never undone.
class ViewState : public QObject {
  Q_OBJECT
 public:
  explicit ViewState(QObject* parent = nullptr) : QObject{parent} {}

  Stage stage() const { return stage_; }
  const std::string& landmark() const { return landmark_; }
  const std::string& muscle() const { return muscle_; }
  /// Slot of a view's radiograph, the patient's or the phantom's.
  static int slotOf(int view, bool phantom) { return 2 * view + (phantom ? 1 : 0); }
  DisplayWindow window(int slot) const;

  /// Whether the model explorer is looked at instead of a stage or the first page.
  bool explorer() const { return explorer_; }

  /// Likewise the retargeting workspace; it and the explorer exclude each other.
  bool retargeting() const { return retargeting_; }

  void setStage(Stage stage);
  void setExplorer(bool shown);
  void setRetargeting(bool shown);
  void setLandmark(const std::string& name);
  void setMuscle(const std::string& name);
  void setWindow(int slot, const DisplayWindow& window);
  void reset();  ///< for another case

 signals:
  void stageChanged();  ///< or the explorer or the retargeting workspace instead
  void landmarkChanged();
  void muscleChanged();
  void windowChanged(int slot);

 private:
  Stage stage_ = Stage::Images;
  bool explorer_ = false, retargeting_ = false;
  std::string landmark_, muscle_;
  std::map<int, DisplayWindow> windows_;  ///< by slot; absent = as the file says
};

}  // namespace sinew
