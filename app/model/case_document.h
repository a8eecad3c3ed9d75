#pragma once
#include <QObject>
#include <QString>
#include <array>
#include <filesystem>
#include <functional>
#include <optional>

#include "clinical/case/case.h"
#include "clinical/pipeline/pipeline.h"
#include "core/undo_history.h"

namespace sinew {

/// The open case: its value, its undo history and its folder. The only door to a change is edit().
/// Lives on the GUI thread; jobs work on copies.
class CaseDocument : public QObject {
  Q_OBJECT
 public:
  explicit CaseDocument(QObject* parent = nullptr);

  bool isOpen() const { return !folder_.empty(); }
  const std::filesystem::path& folder() const { return folder_; }
  /// The case as the person sees it: with the change of a drag that is going on. An empty case if none is open.
  const Case& current() const { return preview_ ? *preview_ : history_.current(); }
  /// Differs from what is stored in the folder.
  bool isModified() const { return modified_; }

  /// @throws InputError if the folder holds no readable case; the open case then stays.
  void open(const std::filesystem::path& folder);
  /// Shows `c`, which has just been stored in `folder`.
  void adopt(Case c, const std::filesystem::path& folder);
  void close();
  /// @throws InputError if the folder cannot be written; nothing is lost.
  void save();

  /// Applies `change` to a copy; the copy becomes one undo step named `label`. If `change` throws InputError nothing
  /// happens but rejected(message). A change that alters nothing makes no step. Returns whether the case changed.
  bool edit(const QString& label, const std::function<void(Case&)>& change);
  /// Shows `change` without making a step (a drag); the next edit, or dropPreview(), ends it.
  void preview(const std::function<void(Case&)>& change);
  void dropPreview();

  bool canUndo() const { return isOpen() && history_.canUndo(); }
  bool canRedo() const { return isOpen() && history_.canRedo(); }
  QString undoLabel() const { return QString::fromStdString(history_.undoLabel()); }
  QString redoLabel() const { return QString::fromStdString(history_.redoLabel()); }
  void undo();
  void redo();

  /// State of a stage; kept until the next change, because it hashes the stage's inputs.
  StageState stateOf(Stage stage) const;

 signals:
  void replaced();   ///< another case, or none
  void changed();    ///< a step forward or back, or replaced
  void previewed();  ///< a preview came or went
  void rejected(const QString& message);
  void saved();

 private:
  void announce();

  UndoHistory<Case> history_{Case{}};
  std::optional<Case> preview_;
  Case stored_;
  std::filesystem::path folder_;
  bool modified_ = false;
  mutable std::array<std::optional<StageState>, kStages.size()> states_;
};

}  // namespace sinew
