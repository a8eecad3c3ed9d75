#pragma once
#include <QWidget>

class QLabel;
class QLineEdit;
class QTableView;

namespace sinew {

class ActivationControls;
class Explorer;
class MuscleTable;

/// Finds a muscle by name or group as one types; the list also says which colour and value each one has.
class MuscleFinder : public QWidget {
  Q_OBJECT
 public:
  explicit MuscleFinder(Explorer& explorer, QWidget* parent = nullptr);
  void focusSearch();

 private:
  void search();
  void showChosen();

  Explorer& explorer_;
  QLineEdit* search_;
  QLabel* count_;
  QTableView* list_;
  MuscleTable* table_;
};

}  // namespace sinew
