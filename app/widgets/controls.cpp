#include "app/widgets/controls.h"

#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/widgets/theme.h"

namespace sinew {

Card::Card(const QString& heading, QWidget* parent) : QFrame{parent} {
  setProperty("role", "card");
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(16, 12, 16, 14);
  column->setSpacing(8);
  if (!heading.isEmpty()) {
    auto* title = new QLabel{heading};
    title->setProperty("role", "heading");
    column->addWidget(title);
  }
  content_ = new QVBoxLayout;
  content_->setSpacing(8);
  column->addLayout(content_, 1);
}

QTableWidget* makeTable(const QString& object_name, const QStringList& headers) {
  auto* table = new QTableWidget{0, int(headers.size())};
  table->setObjectName(object_name);
  table->setHorizontalHeaderLabels(headers);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(28);
  table->horizontalHeader()->setHighlightSections(false);
  table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table->setShowGrid(false);
  table->setAlternatingRowColors(true);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  table->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  table->setWordWrap(false);
  return table;
}

QTableWidgetItem* setCell(QTableWidget& table, int row, int column, const QString& text, Qt::Alignment alignment) {
  QTableWidgetItem* item = table.item(row, column);
  if (!item) {
    item = new QTableWidgetItem;
    table.setItem(row, column, item);
  }
  item->setText(text);
  item->setTextAlignment(alignment);
  return item;
}

QPushButton* makeButton(const QString& object_name, const QString& text, const QString& icon_name,
                        const QString& tip) {
  auto* button = new QPushButton{text};
  button->setObjectName(object_name);
  if (!icon_name.isEmpty()) button->setIcon(icon(icon_name));
  button->setToolTip(tip);
  button->setAccessibleName(tip.isEmpty() ? text : tip);
  return button;
}

std::filesystem::path askForFile(QWidget* parent, const QString& title, const QString& filter) {
  return QFileDialog::getOpenFileName(parent, title, {}, filter).toStdString();
}

std::filesystem::path askForNewFile(QWidget* parent, const QString& title, const QString& proposal,
                                    const QString& filter) {
  return QFileDialog::getSaveFileName(parent, title, proposal, filter).toStdString();
}

std::filesystem::path askForFolder(QWidget* parent, const QString& title) {
  return QFileDialog::getExistingDirectory(parent, title).toStdString();
}

}  // namespace sinew
