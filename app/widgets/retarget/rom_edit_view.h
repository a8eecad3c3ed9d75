#pragma once
#include <QWidget>

#include "app/model/retarget/retarget_design.h"
#include "app/model/retarget/rom_edit_study.h"

class QLabel;
class QStackedWidget;
class QTableWidget;
class QTimer;
class QVBoxLayout;

namespace sinew {

class ColourBar;
class EditSphere;
class RangeBar;
class RomEditPanel;
class RomSphereView;

/// The range of one joint before an edit, as it is wanted - with handles to drag -, and as it is reached; which
/// muscles changed for it.
class RomEditView : public QWidget {
  Q_OBJECT
 public:
  RomEditView(DesignDocument& document, RomEditPanel& panel, QWidget* parent = nullptr);

  void setReference(std::shared_ptr<const RetargetReference> reference) { reference_ = std::move(reference); }
  void setBody(std::shared_ptr<const SolvedBody> body, bool is_current);
  const RomEditStudy& study() const { return study_; }

 signals:
  void muscleChosen(const std::string& unit);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeSpheres();
  QWidget* makeHinge();
  QWidget* makeChanges();
  void askSoon();
  void ask();
  void showPicture();
  void showCone();
  void showTwist();
  void showHinge();
  void showChanges();
  void change(bool keep, const QString& what, const std::function<void(RomEdit&)>& change);
  QString solvedError() const;  ///< of the joint, as the solver counts it
  RomEdit currentEdit() const;

  DesignDocument& document_;
  RomEditPanel& panel_;
  std::shared_ptr<const RetargetReference> reference_;
  std::shared_ptr<const SolvedBody> body_;
  bool current_ = false;
  RomEditStudy study_;
  QVBoxLayout* rows_;
  QStackedWidget* kinds_;
  EditSphere* wanted_;
  RomSphereView *before_, *reached_;
  RangeBar *twist_, *hinge_;
  QLabel *title_, *error_, *hinge_words_, *changes_title_;
  QTableWidget* changes_;
  ColourBar* bar_;
  QTimer* soon_;
  std::function<void(RomEdit&)> pulled_;  ///< the drag that is going on
};

}  // namespace sinew
