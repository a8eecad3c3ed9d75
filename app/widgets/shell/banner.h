#pragma once
#include <QFrame>

class QLabel;
class QTimer;

namespace sinew {

/// One line across the page: a problem (stays until closed), or a notice (goes by itself).
class Banner : public QFrame {
  Q_OBJECT
 public:
  explicit Banner(QWidget* parent = nullptr);
  void showProblem(const QString& message);
  void showNotice(const QString& message);

 private:
  void showLine(const char* kind, const char* sign, const QColor& color, const QString& message);
  QLabel *sign_, *text_;
  QTimer* timer_;
};

}  // namespace sinew
