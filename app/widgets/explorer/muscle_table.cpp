#include "app/widgets/explorer/muscle_table.h"

#include <QColor>
#include <QIcon>
#include <QPixmap>
#include <algorithm>

#include "app/model/explorer/explorer.h"
#include "app/model/stage_text.h"

namespace sinew {
namespace {

const MusculotendonUnit& unitAt(const Explorer& explorer, int unit) {
  return explorer.model()->musculature.units[std::size_t(unit)];
}

QIcon chip(const Rgb& c) {
  QPixmap pixmap{12, 12};
  pixmap.fill(QColor::fromRgbF(float(c.r), float(c.g), float(c.b)));
  QIcon icon;  // the same in a chosen row: the colour is read
  for (const auto mode : {QIcon::Normal, QIcon::Selected}) icon.addPixmap(pixmap, mode);
  return icon;
}

}  // namespace

Rgb muscleColour(const Explorer& explorer, int unit) {
  const auto scale = explorer.colourScale();
  if (!scale) return groupColour(unitAt(explorer, unit).group);
  const double t = (scale->by_unit[std::size_t(unit)] - scale->low) / (scale->high - scale->low);
  return scale->diverging ? divergingColour(t) : sequentialColour(t);
}

MuscleTable::MuscleTable(const Explorer& explorer, QObject* parent)
    : QAbstractTableModel{parent}, explorer_{explorer} {}

void MuscleTable::setRows(std::vector<int> units) {
  beginResetModel();
  rows_ = std::move(units);
  endResetModel();
}

int MuscleTable::rowOf(int unit) const {
  const auto found = std::ranges::find(rows_, unit);
  return found == rows_.end() ? -1 : int(found - rows_.begin());
}

void MuscleTable::refreshValues() {
  if (!rows_.empty()) emit dataChanged(index(0, 0), index(int(rows_.size()) - 1, 1));
  emit headerDataChanged(Qt::Horizontal, 1, 1);
}

int MuscleTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : int(rows_.size());
}

QVariant MuscleTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= int(rows_.size())) return {};
  const int unit = rows_[std::size_t(index.row())];
  if (role == Qt::UserRole) return QString::fromStdString(unitAt(explorer_, unit).name);
  if (role == Qt::ToolTipRole)
    return readableName(unitAt(explorer_, unit).name) + '\n' + readableName(unitAt(explorer_, unit).group);
  if (index.column() == 0) {
    if (role == Qt::DisplayRole) return readableName(unitAt(explorer_, unit).name);
    if (role == Qt::DecorationRole) return chip(muscleColour(explorer_, unit));
  } else {
    const auto scale = explorer_.colourScale();
    if (role == Qt::DisplayRole)
      return scale ? figure(scale->by_unit[std::size_t(unit)], scale->diverging ? 2 : 0) : QString{};
    if (role == Qt::TextAlignmentRole) return int(Qt::AlignRight | Qt::AlignVCenter);
  }
  return {};
}

QVariant MuscleTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::TextAlignmentRole) return int((section == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
  if (role != Qt::DisplayRole) return {};
  if (section == 0) return tr("Muscle");
  switch (explorer_.colouring()) {
    case MuscleColouring::Activation:
      return tr("%");
    case MuscleColouring::FiberLength:
      return tr("L/L0");
    case MuscleColouring::PassiveForce:
      return tr("% Fmax");
    case MuscleColouring::Group:
      return QString{};
  }
  return {};
}

}  // namespace sinew
