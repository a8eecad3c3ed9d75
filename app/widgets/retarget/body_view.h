#pragma once
#include <QSplitter>
#include <memory>
#include <string>

#include "app/model/retarget/body_solver.h"

class QComboBox;
class QTimer;

namespace sinew {

class ChangeInspector;
class ColourBar;
class FamilyCurves;
class ModelView;

/// The body that is being shaped with its muscles, the curves of one muscle, and all muscles ranked by change of
/// function.
class BodyView : public QSplitter {
  Q_OBJECT
 public:
  explicit BodyView(BodySolver& solver, QWidget* parent = nullptr);

  const std::string& muscle() const { return muscle_; }  ///< empty: none
  void setMuscle(const std::string& unit);
  void focusSearch();
  /// The whole body comes into sight again; while a hand drags (`dragging`) it stays where it is.
  void designChanged(bool dragging);

 private:
  QWidget* makeView();
  std::shared_ptr<const Model> shownModel() const;
  void refreshSoon();
  void refresh();

  BodySolver& solver_;
  std::string muscle_;
  ModelView* view_;
  QComboBox *shown_, *colouring_;
  ColourBar* bar_;
  FamilyCurves* curves_;
  ChangeInspector* inspector_;
  QTimer* soon_;
  std::shared_ptr<const Model> drawn_;
  bool fit_wanted_ = true, dragging_ = false;
};

}  // namespace sinew
