#pragma once
#include <QFrame>
#include <QString>
#include <QStringList>
#include <QTableWidget>
#include <filesystem>

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

/// A table to read: whole rows, no grid, no editing.
QTableWidget* makeTable(const QString& object_name, const QStringList& headers);
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
