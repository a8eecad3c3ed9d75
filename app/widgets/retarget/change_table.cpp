#include "app/widgets/retarget/change_table.h"

#include <QColor>
#include <cmath>

#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"
#include "core/retarget/retarget.h"

namespace sinew {
QString energyText(double energy) {
  if (energy < 5e-4) return QStringLiteral("0");
  return figure(energy, energy < 1 ? 3 : energy < 100 ? 2 : 0);
}

ChangeTable::ChangeTable(QObject* parent) : QAbstractTableModel{parent} {}

void ChangeTable::setBody(std::shared_ptr<const SolvedBody> body, bool is_current) {
  if (body == body_) {
    if (is_current != current_ && rowCount() > 0) {
      current_ = is_current;
      emit dataChanged(index(0, 0), index(rowCount() - 1, kColumns - 1), {Qt::ForegroundRole});
    }
    return;
  }
  current_ = is_current;
  if (body && body_ && body->changes.size() == body_->changes.size()) {  // rows stay: so does what is chosen
    body_ = std::move(body);
    emit dataChanged(index(0, 0), index(rowCount() - 1, kColumns - 1));
    return;
  }
  beginResetModel();
  body_ = std::move(body);
  endResetModel();
}

int ChangeTable::rowOf(const std::string& unit) const {
  if (!body_) return -1;
  const auto& units = body_->model->musculature.units;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (units[i].name == unit) return int(i);
  return -1;
}

std::string ChangeTable::unitOf(int row) const {
  return body_->model->musculature.units[std::size_t(row)].name;
}

int ChangeTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() || !body_ ? 0 : int(body_->changes.size());
}

QVariant ChangeTable::figureOf(const MuscleChange& c, int column) const {
  switch (column) {
    case Naive:
      return c.energy_naive;
    case Retargeted:
      return c.energy;
    case Reversals:
      return 1000 * c.reversals_naive + c.reversals;
    case Length:
      return c.length_factor * c.rom_factor;
    case Ratio:
      return c.ratio_factor;
    case Move:
      return c.largest_move_m;
    case Peak:
      return std::abs(c.peak_after_deg);
    default:
      return readableName(unitOf(c.unit));
  }
}

QString ChangeTable::wordsOf(const MuscleChange& c, int column) const {
  const QString arrow = QStringLiteral(" → ");
  switch (column) {
    case Naive:
      return energyText(c.energy_naive);
    case Retargeted:
      return energyText(c.energy);
    case Reversals:
      return QString::number(c.reversals_naive) + arrow + QString::number(c.reversals);
    case Length:
      return QStringLiteral("× ") + figure(c.length_factor * c.rom_factor, 2);
    case Ratio:
      return QStringLiteral("× ") + figure(c.ratio_factor, 2);
    case Move:
      return figure(1000 * c.largest_move_m, 1);
    case Peak:
      return c.peak_motion.empty() ? QStringLiteral("–")
                                   : figure(c.peak_before_deg, 0) + arrow + figure(c.peak_after_deg, 0);
    default:
      return readableName(unitOf(c.unit)).replace(tr(", right"), tr(", R")).replace(tr(", left"), tr(", L"));
  }
}

QVariant ChangeTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const MuscleChange& c = body_->changes[std::size_t(index.row())];
  switch (role) {
    case Qt::DisplayRole:
      return wordsOf(c, index.column());
    case Qt::UserRole:
      return figureOf(c, index.column());
    case Qt::TextAlignmentRole:
      return int((index.column() == Name ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    case Qt::ForegroundRole:
      if (!current_) return colour::kMuted;
      if (index.column() == Reversals && c.reversals > 0) return colour::kDanger;
      return {};
    case Qt::ToolTipRole: {
      QString tip = readableName(unitOf(c.unit)) + '\n' + tr("%1 joint motions").arg(c.motions);
      if (!c.peak_motion.empty())
        tip += '\n' + tr("Peak torque furthest off in: %1").arg(readableName(c.peak_motion).toLower());
      return tip;
    }
    default:
      return {};
  }
}

QVariant ChangeTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::TextAlignmentRole) return int((section == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
  static const std::array<std::pair<QString, QString>, kColumns> kHeads = {{
      {tr("Muscle"), tr("Musculotendon unit")},
      {tr("Naive"),
       tr("Change of function with points that move with the bones: energy of routing, 0 = as in the reference")},
      {tr("Retargeted"), tr("Change of function that is left after retargeting: energy of routing")},
      {tr("Reversed"), tr("Joint motions in which it lengthens where the reference's shortens, or the other way: "
                          "naive → retargeted")},
      {tr("Length"), tr("Fibre and tendon length over the reference's, edits of ranges of motion included")},
      {tr("Ratio"), tr("Fibre : tendon ratio over the reference's")},
      {tr("Move, mm"), tr("Largest move of a path point against moving with its bone")},
      {tr("Peak, °"), tr("Angle of peak torque against the reference's, of the motion where it is furthest off: with "
                         "the reference's fibre : tendon ratios → optimised")},
  }};
  if (role == Qt::DisplayRole) return kHeads[std::size_t(section)].first;
  if (role == Qt::ToolTipRole) return kHeads[std::size_t(section)].second;
  return {};
}

}  // namespace sinew
