#pragma once
#include <QWidget>
#include <memory>
#include <string>

class QLabel;
class QLineEdit;
class QSortFilterProxyModel;
class QTableView;

namespace sinew {

class ChangeTable;
struct SolvedBody;

/// Ranks the muscles by what a new body did to their function; finds one by name.
class ChangeInspector : public QWidget {
  Q_OBJECT
 public:
  explicit ChangeInspector(QWidget* parent = nullptr);

  void setBody(const std::shared_ptr<const SolvedBody>& body, bool is_current);
  void select(const std::string& unit);
  void focusSearch();

 signals:
  void chosen(const std::string& unit);

 private:
  void summarise(const SolvedBody* body);

  QLineEdit* search_;
  QLabel* summary_;
  QTableView* list_;
  ChangeTable* table_;
  QSortFilterProxyModel* order_;
};

}  // namespace sinew
