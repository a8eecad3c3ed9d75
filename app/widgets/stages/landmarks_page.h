#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/widgets/stages/stage_page.h"
#include "core/skeleton/fit/landmark_protocol.h"

class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;
class QTimer;
class QToolButton;

namespace sinew {

class RadiographPane;

/// Placing landmarks in the radiographs, two at a time: click places, drag moves (one undo step on release), Delete
/// removes; the other view shows where the same point must lie; residuals follow the hand.
class LandmarksPage : public StagePage {
  Q_OBJECT
 public:
  explicit LandmarksPage(Workspace& workspace);

  void importSightings(const std::filesystem::path& file);
  void exportSightings(const std::filesystem::path& file);
  /// The next landmark of the list that is not placed in two views, after the selected one.
  void selectNextMissing();

 protected:
  void refresh() override;
  void refreshPreview() override { refreshFindings(); }
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct Finding {
    std::set<int> seen;  ///< views
    double residual_px = std::numeric_limits<double>::quiet_NaN();
    double sd_mm = std::numeric_limits<double>::quiet_NaN();
    std::map<int, Eigen::Vector2d> residual;  ///< by view
  };
  void connectPane(RadiographPane& pane);
  void buildList(QWidget& side);
  QWidget* makeExchangeFrame();
  void refreshNames();
  void refreshFindings();
  void refreshAdvice();  ///< what further landmarks would determine, by a fit of what is placed
  void refreshMarks();
  void refreshCard();
  void refreshExchange();
  void filterRows();
  void step(int direction);
  void removeSelected(bool all_views);
  int viewCount() const;
  void refreshColumns();
  void place(RadiographPane& pane, const std::string& name, const QPointF& uv_px);
  double sigmaOfPick(RadiographPane& pane,
                     const std::string& name);  ///< what the protocol says of a click, in pixels

  QString titleOfLandmark(const std::string& name) const;

  std::vector<ProtocolLandmark> protocol_;
  std::vector<std::string> names_;
  std::map<std::string, Finding> findings_;
  std::array<RadiographPane*, 2> panes_;
  QTableWidget* table_;
  QLineEdit* search_;
  QLabel *progress_, *card_title_, *card_text_, *rms_, *advice_;
  QTimer* advice_timer_;              ///< the hand must rest before anything is fitted
  std::vector<Sighting> advised_on_;  ///< what the advice on the page was made from
  QPushButton* remove_;
  QWidget* exchange_frame_;  ///< shown while left and right are found exchanged
  QLabel* exchange_text_;
  int last_view_ = 0;  ///< the one that was used last: Delete works there
};

}  // namespace sinew
