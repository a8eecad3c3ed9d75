#pragma once
#include <QWidget>

class QPushButton;

namespace sinew {

class Workspace;

/// What one sees without a case: ways to begin.
class WelcomePage : public QWidget {
  Q_OBJECT
 public:
  explicit WelcomePage(Workspace& workspace, QWidget* parent = nullptr);

 signals:
  void openWanted();
  void newWanted();
  void demoWanted();
  void explorerWanted();
  void retargetingWanted();

 private:
  QPushButton* makeChoice(const QString& object_name, const QString& icon_name, const QString& title,
                          const QString& text);
};

}  // namespace sinew
