#pragma once
#include <QDoubleSpinBox>
#include <QFrame>
#include <QLabel>
#include <QString>
#include <QStringList>
#include <QTableWidget>
#include <filesystem>

class QLineEdit;
class QPushButton;
class QVBoxLayout;

namespace sinew {

/// A white surface with a heading.
class Card : public QFrame {
  Q_OBJECT
 public:
  explicit Card(const QString& heading = {}, QWidget* parent = nullptr);
  QVBoxLayout& content() { return *content_; }

 private:
  QVBoxLayout* content_;
};

/// One line that ends in an ellipsis where it has no room; the whole text is then its tool tip.
class ElidedLabel : public QLabel {
  Q_OBJECT
 public:
  explicit ElidedLabel(const char* role, QWidget* parent = nullptr);
  QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }
  bool isElided() const { return shownText() != text(); }

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent*) override;

 private:
  QString shownText() const;
};

/// A number in a list that scrolls: wheel events go to the list unless the field is being edited.
class PatientSpinBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  using QDoubleSpinBox::QDoubleSpinBox;

 protected:
  void wheelEvent(QWheelEvent* event) override;
};

/// A field to search a list with.
QLineEdit* makeSearchField(const QString& object_name, const QString& hint);

/// A table to read: whole rows, no grid, no editing.
QTableWidget* makeTable(const QString& object_name, const QStringList& headers);
/// Long cells go over several lines, and the rows follow the width of the columns.
void wrapRows(QTableWidget& table);
/// Text of a cell; made if it is not there yet.
QTableWidgetItem* setCell(QTableWidget& table, int row, int column, const QString& text,
                          Qt::Alignment alignment = Qt::AlignLeft | Qt::AlignVCenter);
inline constexpr Qt::Alignment kNumber = Qt::AlignRight | Qt::AlignVCenter;

QPushButton* makeButton(const QString& object_name, const QString& text, const QString& icon_name,
                        const QString& tip);

/// Empty if the person cancels.
std::filesystem::path askForFile(QWidget* parent, const QString& title, const QString& filter);
std::filesystem::path askForNewFile(QWidget* parent, const QString& title, const QString& proposal,
                                    const QString& filter);
std::filesystem::path askForFolder(QWidget* parent, const QString& title);

}  // namespace sinew
