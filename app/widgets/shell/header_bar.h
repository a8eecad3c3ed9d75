#pragma once
#include <QWidget>

class QAction;
class QLabel;

namespace sinew {

class Workspace;

/// What can be done to the case as a whole, and whose case it is.
class HeaderBar : public QWidget {
  Q_OBJECT
 public:
  struct Actions {
    QAction *new_case, *open, *save, *undo, *redo, *patient;
  };
  HeaderBar(Workspace& workspace, const Actions& actions, QWidget* parent = nullptr);

 private:
  void refresh();
  Workspace& workspace_;
  Actions actions_;
  QLabel *patient_, *details_, *saved_;
};

}  // namespace sinew
