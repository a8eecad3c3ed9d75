#include "app/widgets/retarget/change_inspector.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>

#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/retarget/change_table.h"

namespace sinew {
namespace {

/// Every word that was typed, in any order.
class WordFilter : public QSortFilterProxyModel {
 public:
  using QSortFilterProxyModel::QSortFilterProxyModel;
  void setWords(const QString& text) {
    words_ = text.split(' ', Qt::SkipEmptyParts);
    invalidateFilter();
  }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override {
    const QString name = sourceModel()->index(row, 0, parent).data(Qt::UserRole).toString();
    return std::ranges::all_of(words_, [&](const QString& w) { return name.contains(w, Qt::CaseInsensitive); });
  }

 private:
  QStringList words_;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

ChangeInspector::ChangeInspector(QWidget* parent) : QWidget{parent} {
  setObjectName("change_inspector");
  search_ = makeSearchField("retarget_search", tr("Find a muscle"));
  search_->setFixedWidth(190);
  summary_ = new ElidedLabel{"small"};
  summary_->setObjectName("retarget_summary");
  table_ = new ChangeTable{this};
  auto* filter = new WordFilter{this};
  order_ = filter;
  order_->setSourceModel(table_);
  order_->setSortRole(Qt::UserRole);
  order_->setDynamicSortFilter(true);
  list_ = new QTableView;
  list_->setObjectName("change_list");
  list_->setAccessibleName(tr("Muscles by change of function"));
  list_->setModel(order_);
  list_->setSortingEnabled(true);
  list_->sortByColumn(ChangeTable::Naive, Qt::DescendingOrder);
  list_->setShowGrid(false);
  list_->setAlternatingRowColors(true);
  list_->setSelectionBehavior(QAbstractItemView::SelectRows);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->setTabKeyNavigation(false);
  list_->setWordWrap(false);
  list_->verticalHeader()->hide();
  list_->verticalHeader()->setDefaultSectionSize(24);
  auto* header = list_->horizontalHeader();
  header->setHighlightSections(false);
  header->setSectionResizeMode(QHeaderView::Fixed);
  header->setSectionResizeMode(0, QHeaderView::Stretch);
  constexpr int kWidths[] = {0, 64, 88, 74, 58, 56, 80, 90};
  for (int c = 1; c < ChangeTable::kColumns; ++c) header->resizeSection(c, kWidths[c]);
  auto* top = new QHBoxLayout;
  top->setContentsMargins(0, 0, 0, 0);
  top->addWidget(search_);
  top->addSpacing(6);
  top->addWidget(summary_, 1);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addLayout(top);
  column->addWidget(list_, 1);

  connect(search_, &QLineEdit::textChanged, this, [this, filter](const QString& text) {
    filter->setWords(text);
    list_->scrollToTop();
  });
  connect(search_, &QLineEdit::returnPressed, this, [this] {
    if (order_->rowCount() == 0) return;
    list_->setFocus();
    list_->selectRow(0);
    list_->scrollToTop();
  });
  connect(list_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex& index) {
    if (index.isValid()) emit chosen(table_->unitOf(order_->mapToSource(index).row()));
  });
}

void ChangeInspector::setBody(const std::shared_ptr<const SolvedBody>& body, bool is_current) {
  table_->setBody(body, is_current);
  summarise(body.get());
}

void ChangeInspector::summarise(const SolvedBody* body) {
  if (!body) {
    summary_->setText(tr("The muscles are listed when they are retargeted."));
    return;
  }
  std::vector<double> naive, retargeted;
  int reversed_naive = 0, reversed = 0;
  for (const MuscleChange& c : body->changes) {
    naive.push_back(c.energy_naive);
    retargeted.push_back(c.energy);
    reversed_naive += c.reversals_naive > 0;
    reversed += c.reversals > 0;
  }
  summary_->setText(tr("Median change %1 naive, %2 retargeted · muscles reversed somewhere %3, %4")
                        .arg(energyText(median(naive)), energyText(median(retargeted)))
                        .arg(reversed_naive)
                        .arg(reversed));
}

void ChangeInspector::select(const std::string& unit) {
  const int row = table_->rowOf(unit);
  const QModelIndex index = row < 0 ? QModelIndex{} : order_->mapFromSource(table_->index(row, 0));
  if (!index.isValid()) {
    list_->clearSelection();
  } else if (list_->currentIndex().row() != index.row() || !list_->selectionModel()->isRowSelected(index.row())) {
    list_->selectRow(index.row());
    list_->scrollTo(index);
  }
}

void ChangeInspector::focusSearch() {
  search_->setFocus();
  search_->selectAll();
}

}  // namespace sinew
