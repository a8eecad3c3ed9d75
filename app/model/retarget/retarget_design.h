#pragma once
#include <QObject>
#include <QString>
#include <functional>
#include <optional>

#include "core/rom/edit/rom_edit.h"
#include "core/skeleton/shape/body_description.h"
#include "core/undo_history.h"

namespace sinew {

/// What a person designs: a body, and edits of its ranges of motion. The default is the reference itself.
struct RetargetDesign {
  BodyDescription body;
  RomEdits rom;
  friend bool operator==(const RetargetDesign&, const RetargetDesign&) = default;
};

/// Name of the body that was taken from the open case; never a person's.
inline constexpr const char* kPatientBody = "this patient";

/// The design, its undo history and the drag that is going on. The only door to a change is edit() or preview().
class DesignDocument : public QObject {
  Q_OBJECT
 public:
  explicit DesignDocument(QObject* parent = nullptr);

  /// With the change of a drag, if there is one.
  const RetargetDesign& current() const { return preview_ ? *preview_ : history_.current(); }
  bool isPreview() const { return preview_.has_value(); }

  /// Applies `change` to a copy; the copy becomes one undo step named `label`. If `change` throws InputError nothing
  /// happens but rejected(message). A change that alters nothing makes no step. Returns whether the design changed.
  bool edit(const QString& label, const std::function<void(RetargetDesign&)>& change);
  /// Shows `change` of the last step without making a step (a drag); edit() ends it, and so does dropPreview().
  void preview(const std::function<void(RetargetDesign&)>& change);
  void dropPreview();

  /// Begins again with `design`; nothing of before can be undone to.
  void reset(RetargetDesign design);

  bool canUndo() const { return history_.canUndo(); }
  bool canRedo() const { return history_.canRedo(); }
  QString undoLabel() const { return QString::fromStdString(history_.undoLabel()); }
  QString redoLabel() const { return QString::fromStdString(history_.redoLabel()); }
  void undo();
  void redo();

 signals:
  void changed();    ///< a step forward or back
  void previewed();  ///< a preview came, moved or went
  void rejected(const QString& message);

 private:
  UndoHistory<RetargetDesign> history_{RetargetDesign{}};
  std::optional<RetargetDesign> preview_;
};

}  // namespace sinew
