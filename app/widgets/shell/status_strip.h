#pragma once
#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace sinew {

class Workspace;

/// Bottom line: what is being computed, how far it is, and the button that stops it.
class StatusStrip : public QWidget {
  Q_OBJECT
 public:
  explicit StatusStrip(Workspace& workspace, QWidget* parent = nullptr);

 private:
  void idle();
  Workspace& workspace_;
  QLabel *text_, *note_;
  QProgressBar* bar_;
  QPushButton* cancel_;
};

}  // namespace sinew
