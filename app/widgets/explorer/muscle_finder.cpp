#include "app/widgets/explorer/muscle_finder.h"

#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QTableView>
#include <QVBoxLayout>

#include "app/model/explorer/explorer.h"
#include "app/model/explorer/muscle_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/explorer/activation_controls.h"
#include "app/widgets/explorer/muscle_table.h"

namespace sinew {
MuscleFinder::MuscleFinder(Explorer& explorer, QWidget* parent) : QWidget{parent}, explorer_{explorer} {
  setObjectName("muscle_finder");
  search_ = makeSearchField("explorer_search", tr("Find a muscle or group"));
  count_ = makeLabel({}, "small");
  count_->setObjectName("explorer_count");
  count_->setWordWrap(true);
  table_ = new MuscleTable{explorer_, this};
  list_ = new QTableView;
  list_->setObjectName("explorer_list");
  list_->setAccessibleName(tr("Muscles"));
  list_->setModel(table_);
  list_->setShowGrid(false);
  list_->setAlternatingRowColors(true);
  list_->setSelectionBehavior(QAbstractItemView::SelectRows);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->setTabKeyNavigation(false);
  list_->setWordWrap(true);
  list_->verticalHeader()->hide();
  list_->verticalHeader()->setDefaultSectionSize(26);
  list_->horizontalHeader()->setHighlightSections(false);
  list_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Fixed);
  list_->horizontalHeader()->resizeSection(1, 62);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(10, 10, 10, 8);
  column->setSpacing(6);
  column->addWidget(search_);
  column->addWidget(count_);
  column->addWidget(list_, 1);
  column->addWidget(new ActivationControls{explorer_});

  connect(list_->horizontalHeader(), &QHeaderView::sectionResized, list_, &QTableView::resizeRowsToContents);
  connect(search_, &QLineEdit::textChanged, this, &MuscleFinder::search);
  connect(search_, &QLineEdit::returnPressed, this, [this] {
    if (table_->rows().empty()) return;
    list_->setFocus();
    list_->selectRow(0);
  });
  connect(list_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex& index) {
    if (index.isValid()) explorer_.setMuscle(index.data(Qt::UserRole).toString().toStdString());
  });
  connect(&explorer_, &Explorer::modelChanged, this, &MuscleFinder::search);
  connect(&explorer_, &Explorer::muscleChanged, this, &MuscleFinder::showChosen);
  connect(&explorer_, &Explorer::postureChanged, table_, &MuscleTable::refreshValues);
  connect(&explorer_, &Explorer::coloursChanged, this, [this] {
    const bool hidden = explorer_.colouring() == MuscleColouring::Group;
    table_->refreshValues();
    if (hidden == list_->isColumnHidden(1)) return;
    list_->setColumnHidden(1, hidden);
    list_->resizeRowsToContents();
  });
  list_->setColumnHidden(1, true);
}

void MuscleFinder::focusSearch() {
  search_->setFocus();
  search_->selectAll();
}

void MuscleFinder::search() {
  if (!explorer_.model()) return;
  const auto& musculature = explorer_.model()->musculature;
  auto found = findMuscles(musculature, search_->text());
  count_->setText(found.nearest ? tr("No such name. Nearest:")
                  : found.units.size() == musculature.units.size()
                      ? tr("%1 musculotendon units").arg(found.units.size())
                      : tr("%1 of %2 musculotendon units").arg(found.units.size()).arg(musculature.units.size()));
  {
    const QSignalBlocker block{list_->selectionModel()};  // the first row must not become chosen by itself
    table_->setRows(std::move(found.units));
  }
  list_->resizeRowsToContents();
  showChosen();
}

void MuscleFinder::showChosen() {
  const int row = table_->rowOf(explorer_.muscleIndex());
  if (row < 0) {
    list_->clearSelection();
  } else if (list_->currentIndex().row() != row || !list_->selectionModel()->isRowSelected(row)) {
    list_->selectRow(row);
    list_->scrollTo(table_->index(row, 0));
  }
}

}  // namespace sinew
