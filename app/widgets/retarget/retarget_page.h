#pragma once
#include <QWidget>

#include "app/model/retarget/body_solver.h"
#include "app/model/retarget/retarget_design.h"

class QLabel;
class QStackedWidget;
class QTabWidget;
class QTimer;
class QToolButton;

namespace sinew {

class BodyView;
class CharactersView;
class FactorPanel;
class RomEditPanel;
class RomEditView;
class ShapePanel;
class Workspace;

/// The retargeting workspace: a body is shaped on the left, seen with its muscles in the middle, and compared with
/// the reference on the right and below. Needs no case.
class RetargetPage : public QWidget {
  Q_OBJECT
 public:
  /// `loader` makes the reference; the default is the product's, tests put something quick in its place.
  explicit RetargetPage(Workspace& workspace, BodySolver::Loader loader = {}, QWidget* parent = nullptr);

  DesignDocument& document() { return document_; }
  BodySolver& solver() { return solver_; }
  BodyView& bodyView() { return *body_view_; }

 signals:
  void closeWanted();
  void undoChanged();  ///< what undo and redo would do

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeHead();
  void designChanged();
  void showBody();
  void showMode();

  Workspace& workspace_;
  BodySolver::Loader loader_;
  DesignDocument document_;

  QLabel* body_name_;
  QToolButton* characters_button_;
  ShapePanel* shape_;
  FactorPanel* factors_;
  RomEditPanel* rom_panel_;
  RomEditView* rom_view_;
  QTabWidget* left_;
  QStackedWidget *right_, *all_;
  BodyView* body_view_;
  CharactersView* characters_;
  QTimer* settle_;
  BodySolver solver_;  ///< last: its threads end before what they use goes
};

}  // namespace sinew
