#pragma once
#include <QAbstractTableModel>
#include <memory>

#include "app/model/retarget/body_solver.h"

namespace sinew {

/// Rows for a view: every muscle with what a new body did to its function. Sorts by Qt::UserRole.
class ChangeTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Name, Naive, Retargeted, Reversals, Length, Ratio, Move, Peak, kColumns };
  explicit ChangeTable(QObject* parent = nullptr);

  /// nullptr: no rows. `is_current`: false greys them, they are of an older design.
  void setBody(std::shared_ptr<const SolvedBody> body, bool is_current);
  int rowOf(const std::string& unit) const;  ///< -1: none
  std::string unitOf(int row) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex&) const override { return kColumns; }
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  QVariant figureOf(const MuscleChange& change, int column) const;
  QString wordsOf(const MuscleChange& change, int column) const;

  std::shared_ptr<const SolvedBody> body_;
  bool current_ = false;
};

/// "0", "0.034", "12.1": three figures tell energies of very different size apart.
QString energyText(double energy);

}  // namespace sinew
