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
class DesignMenus;
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
  /// What is designed, in words: whose body, and that it is not the open case's where it is not.
  QString bodyInWords() const;
  /// The open case's body as far as retargeting goes from bones alone; nullopt before they are fitted.
  std::optional<RetargetDesign> patientDesign() const;
  void takePatient();
  /// Begins with this patient, and drops every trace of another case's.
  void followPatient();
  void showBody();
  void showMode();

  Workspace& workspace_;
  BodySolver::Loader loader_;
  DesignDocument document_;

  std::optional<RetargetDesign> taken_;  ///< the patient's body that was taken last, from this case
  DesignMenus* menus_;
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
