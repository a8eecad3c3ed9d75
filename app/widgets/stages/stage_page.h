#pragma once
#include <QWidget>

#include "clinical/case/case.h"

class QHBoxLayout;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace sinew {

class Workspace;

/// Frame of a page: title, state, run button, what the stage warns of, and below it the page's own content. A page
/// shows the document and asks it for edits; it holds no facts. It follows the document only while it is in sight.
class StagePage : public QWidget {
  Q_OBJECT
 public:
  StagePage(Workspace& workspace, Stage stage, const QString& purpose, QWidget* parent = nullptr);

  Stage stage() const { return stage_; }

 protected:
  /// Shows the document as it is now.
  virtual void refresh() = 0;
  /// Shows a drag that is going on; by default nothing.
  virtual void refreshPreview() {}

  Workspace& workspace() { return workspace_; }
  const Case& shownCase() const;
  QVBoxLayout& body() { return *body_; }
  QHBoxLayout& actions() { return *actions_; }  ///< left of the run button
  void showEvent(QShowEvent* event) override;

 private:
  void update();
  void refreshHead();

  Workspace& workspace_;
  Stage stage_;
  QVBoxLayout* body_;
  QHBoxLayout* actions_;
  QLabel *badge_, *explanation_, *warnings_;
  QPushButton *run_, *more_;
  QWidget* warning_frame_;
  bool outdated_ = true, all_warnings_ = false;
};

}  // namespace sinew
