#pragma once
#include <QWidget>

#include "app/model/retarget/body_solver.h"
#include "app/model/retarget/retarget_design.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSplitter;
class QStackedWidget;
class QTabWidget;
class QTimer;
class QToolButton;

namespace sinew {

class ChangeInspector;
class CharactersView;
class ColourBar;
class FactorPanel;
class FamilyCurves;
class ModelView;
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
  const std::string& muscle() const { return muscle_; }
  void setMuscle(const std::string& unit);

 signals:
  void closeWanted();
  void undoChanged();  ///< what undo and redo would do

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeHead();
  QWidget* makeBodyView();
  QWidget* makeView();
  QWidget* makeState();
  void designChanged();
  void refreshSoon();
  void refresh();
  void refreshState();
  void showBody();
  std::shared_ptr<const Model> shownModel() const;
  void showMode();
  void takePreset(const std::string& name);
  void openBodyFile();
  void saveBodyFile();
  void saveModelFile();
  void exportFile();
  bool isSolvedOr(const QString& wanted_for);
  void report(const std::function<void()>& work);

  Workspace& workspace_;
  BodySolver::Loader loader_;
  DesignDocument document_;
  std::string muscle_;
  QLabel *body_name_, *state_;
  QToolButton* characters_button_;
  QComboBox *shown_, *colouring_;
  ColourBar* bar_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  ShapePanel* shape_;
  FactorPanel* factors_;
  RomEditPanel* rom_panel_;
  RomEditView* rom_view_;
  QTabWidget* left_;
  QStackedWidget *right_, *all_;
  ModelView* view_;
  FamilyCurves* curves_;
  ChangeInspector* inspector_;
  CharactersView* characters_;
  QTimer *soon_, *settle_;
  std::shared_ptr<const Model> drawn_;
  bool fit_wanted_ = true;
  BodySolver solver_;  ///< last: its threads end before what they use goes
};

}  // namespace sinew
