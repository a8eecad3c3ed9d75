#include "app/widgets/controls/controls.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QHelpEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QStyle>
#include <QToolTip>
#include <QVBoxLayout>
#include <QWheelEvent>

#include "app/widgets/controls/theme.h"

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

ElidedLabel::ElidedLabel(const char* role, QWidget* parent) : QLabel{parent} {
  setProperty("role", role);
  setTextFormat(Qt::PlainText);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
}

QString ElidedLabel::shownText() const {
  return fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width());
}

bool ElidedLabel::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && toolTip().isEmpty()) {
    if (isElided())
      QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text(), this);
    else
      QToolTip::hideText();
    return true;
  }
  return QLabel::event(event);
}

void ElidedLabel::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  style()->drawItemText(&painter, contentsRect(), int(alignment()), palette(), isEnabled(), shownText(),
                        foregroundRole());
}

void PatientSpinBox::wheelEvent(QWheelEvent* event) {
  if (hasFocus())
    QDoubleSpinBox::wheelEvent(event);
  else
    event->ignore();
}

QLineEdit* makeSearchField(const QString& object_name, const QString& hint) {
  constexpr int kSign_px = 16;
  auto* field = new QLineEdit;
  field->setObjectName(object_name);
  field->setPlaceholderText(hint);
  field->setAccessibleName(hint);
  field->setClearButtonEnabled(true);
  // QLineEdit's own leading action is placed without regard to the style sheet's minimum height: a label is not.
  field->setTextMargins(kSign_px + 6, 0, 0, 0);
  auto* sign = new QLabel;
  sign->setPixmap(icon("search", colour::kMuted).pixmap(kSign_px, kSign_px));
  sign->setAttribute(Qt::WA_TransparentForMouseEvents);
  auto* line = new QHBoxLayout{field};
  line->setContentsMargins(9, 0, 0, 0);
  line->addWidget(sign);
  line->addStretch();
  return field;
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

void wrapRows(QTableWidget& table) {
  table.setWordWrap(true);
  QObject::connect(table.horizontalHeader(), &QHeaderView::sectionResized, &table,
                   [&table] { table.resizeRowsToContents(); });
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
