#pragma once
#include <QWidget>
#include <filesystem>

#include "app/model/explorer/explorer.h"
#include "app/model/explorer/rom_study.h"
#include "app/scene/model_scene.h"

class QComboBox;
class QLabel;
class QTabWidget;
class QTimer;

namespace sinew {

class ColourBar;
class ModelView;
class MuscleCard;
class MuscleCurves;
class MuscleFinder;
class RomPanel;
class Workspace;

/// A model to look at, with or without a case: the body in three dimensions, every muscle's card and curves, joints
/// to move, ranges of motion.
class ExplorerPage : public QWidget {
  Q_OBJECT
 public:
  /// `mapper` computes the range maps; the default is the product's, tests put something quick in its place.
  explicit ExplorerPage(Workspace& workspace, RomStudy::Mapper mapper = {}, QWidget* parent = nullptr);

  Explorer& explorer() { return explorer_; }
  void openModelFile(const std::filesystem::path& file);

 signals:
  void closeWanted();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  /// Which body is looked at; the data of the list's entries.
  enum class Body { None, Patient, Reference, Athlete, File };

  void fillModels();
  void chooseModel(int index);
  void show(Body body);
  void showPatient();
  /// Shows this patient unless a person chose another body, and never an earlier state or another case's.
  void followPatient();
  void loadInBackground(Body body, const QString& title, std::function<std::shared_ptr<const Model>()> load);
  QWidget* makeView();
  void refreshSoon();
  void refresh();
  void refreshWords();  ///< card or curves, whichever is seen
  /// Shows what the colours mean, and returns them for the view.
  std::optional<MuscleScalars> showColours();
  void showRom();

  Workspace& workspace_;
  Explorer explorer_;
  Body body_ = Body::None;
  bool chosen_by_hand_ = false;
  QComboBox *models_, *colouring_;
  QLabel* whose_;
  ModelView* view_;
  ColourBar* bar_;
  QLabel* validity_;
  MuscleFinder* finder_;
  MuscleCard* card_;
  MuscleCurves* curves_;
  RomPanel* rom_;
  QTabWidget *left_, *right_;
  QTimer* soon_;
  LatestJob loading_;  ///< last: its thread ends before what it uses goes
};

}  // namespace sinew
