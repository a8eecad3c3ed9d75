#pragma once
#include <QObject>
#include <filesystem>
#include <functional>

#include "app/model/retarget/body_solver.h"
#include "app/model/retarget/retarget_design.h"

class QAction;
class QToolButton;
class QWidget;

namespace sinew {

class Workspace;

/// The two menus of the retargeting workspace: bodies to take, and files to write.
class DesignMenus : public QObject {
  Q_OBJECT
 public:
  /// `window` owns the buttons and is where dialogs stand over.
  DesignMenus(Workspace& workspace, DesignDocument& document, BodySolver& solver, QWidget& window);

  QToolButton* bodies() const { return bodies_; }
  QToolButton* files() const { return files_; }

  /// Whether there is a body of this patient to take; it is the first of the menu.
  void offerPatient(bool there);

 signals:
  void patientWanted();

 private:
  void report(const std::function<void()>& work);
  void takePreset(const std::string& name);
  void openBodyFile();
  void saveBodyFile();
  bool isSolvedOr(const QString& wanted_for);
  void saveModelFile();
  void exportFile();
  /// `write` answers what is to be said about the file, or nothing.
  void writeInBackground(const std::filesystem::path& file, std::function<std::string()> write);

  Workspace& workspace_;
  DesignDocument& document_;
  BodySolver& solver_;
  QWidget* window_;
  QAction* patient_;
  QToolButton *bodies_, *files_;
  LatestJob writing_;  ///< last: its thread ends before what it uses goes
};

}  // namespace sinew
