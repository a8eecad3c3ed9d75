#pragma once
#include <QWidget>
#include <functional>
#include <map>

#include "clinical/case/case.h"

class QLabel;
class QPushButton;

namespace sinew {

class Workspace;

/// The stages of the case from top to bottom: state, key figures, and the way to each page.
class StageRail : public QWidget {
  Q_OBJECT
 public:
  explicit StageRail(Workspace& workspace, QWidget* parent = nullptr);

 private:
  struct Entry {
    QPushButton* button;
    QLabel *sign, *title, *line;
  };
  Entry makeEntry(Stage stage);
  /// A place that needs no case: the explorer, the retargeting workspace.
  QPushButton* makePlace(const QString& object_name, const QString& icon_name, const QString& title,
                         const QString& tip, const std::function<void()>& open);
  void refresh();
  void refreshSelection();

  Workspace& workspace_;
  std::map<Stage, Entry> entries_;
  QPushButton *explorer_, *retargeting_, *run_all_;
};

}  // namespace sinew
