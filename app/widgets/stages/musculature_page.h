#pragma once
#include <memory>

#include "app/widgets/stages/stage_page.h"

class QLabel;
class QLineEdit;
class QTableWidget;

namespace sinew {

class Card;
class ModelView;
struct Model;

/// The patient's muscles: model, a list to search, and a card of the selected unit.
class MusculaturePage : public StagePage {
  Q_OBJECT
 public:
  explicit MusculaturePage(Workspace& workspace);

 protected:
  void refresh() override;

 private:
  void fillTable(const Model& model);
  void filterRows();
  void showMuscle();

  ModelView* model_view_;
  QTableWidget *table_, *facts_;
  QLineEdit* search_;
  QLabel *count_, *title_, *subtitle_;
  std::shared_ptr<const Model> listed_;  ///< what the table shows
};

}  // namespace sinew
