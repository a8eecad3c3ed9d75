#pragma once
#include <QAbstractTableModel>
#include <functional>
#include <vector>

#include "app/scene/palette.h"

namespace sinew {

class Explorer;

/// Rows for a view: the muscles that a search found, each with the colour it has in the picture and its value.
class MuscleTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  explicit MuscleTable(const Explorer& explorer, QObject* parent = nullptr);

  void setRows(std::vector<int> units);
  const std::vector<int>& rows() const { return rows_; }
  int rowOf(int unit) const;  ///< -1: not among them
  /// The colours or values of all rows changed.
  void refreshValues();

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex&) const override { return 2; }
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  const Explorer& explorer_;
  std::vector<int> rows_;
};

/// Colour of a unit in the picture, as the explorer's colouring asks.
Rgb muscleColour(const Explorer& explorer, int unit);

}  // namespace sinew
