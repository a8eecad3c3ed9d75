#pragma once
#include <array>

#include "app/widgets/stages/stage_page.h"

class QLabel;
class QPushButton;
class QRadioButton;
class QTableWidget;

namespace sinew {

class RadiographPane;

/// Where the view geometry comes from, how good it is, and the beads it was made from.
class CalibrationPage : public StagePage {
  Q_OBJECT
 public:
  explicit CalibrationPage(Workspace& workspace);

  /// `method`: "json" for one rig file, "autoscoper" or "mayacam" for one text file per view.
  void importRig(const std::vector<std::filesystem::path>& files, const std::string& method);
  /// `images`: one for every radiograph of the case, in its order.
  void importPhantom(const std::vector<std::filesystem::path>& images, const std::filesystem::path& beads);

 protected:
  void refresh() override;

 private:
  QWidget* makeSourceCard();
  QWidget* makeResultCard();
  void askForRig();
  void askForPhantom();
  void refreshGeometry();
  void showBeads();

  QRadioButton *phantom_, *imported_, *tags_;
  QPushButton *choose_phantom_, *choose_rig_;
  QLabel *rms_, *accuracy_, *angle_, *method_;
  QTableWidget* geometry_;
  std::array<RadiographPane*, 2> panes_;
};

}  // namespace sinew
