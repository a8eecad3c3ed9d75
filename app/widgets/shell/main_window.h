#pragma once
#include <QWidget>
#include <map>

#include "app/widgets/shell/header_bar.h"
#include "app/widgets/stages/report_page.h"

class QStackedWidget;

namespace sinew {

class Banner;
class ExplorerPage;
class RetargetPage;
class StagePage;
class Workspace;

/// The window: header, stages on the left, the page of the current stage, status line.
class MainWindow : public QWidget {
  Q_OBJECT
 public:
  MainWindow(Workspace& workspace, ReportStagePage::Renderer render_report);

  void newCase();
  void openCase();
  void openDemo();
  void changePatient();
  void saveCase();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  HeaderBar::Actions makeActions();
  void refreshActions();
  void showStage();
  /// Asks what to do with unsaved changes; false: stay here.
  bool mayLeaveCase();

  Workspace& workspace_;
  HeaderBar::Actions actions_;
  Banner* banner_;
  QStackedWidget* pages_;
  QWidget* welcome_;
  ExplorerPage* explorer_;
  RetargetPage* retarget_;
  std::map<Stage, StagePage*> stage_pages_;
};

}  // namespace sinew
