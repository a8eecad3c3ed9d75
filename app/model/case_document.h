#pragma once
#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "clinical/case/case.h"
#include "clinical/pipeline/pipeline.h"
#include "core/undo_history.h"

namespace sinew {

/// The open case: its value, its undo history and its folder. The only door to a change is edit().
/// Lives on the GUI thread; jobs work on copies.
class CaseDocument : public QObject {
  Q_OBJECT
 public:
  /// `resource_dir`: what the stages read of it decides whether they are done.
  explicit CaseDocument(std::filesystem::path resource_dir, QObject* parent = nullptr);

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
  /// Whether another program wrote into the folder since the case was opened or saved.
  bool wasChangedElsewhere() const;
  /// @throws InputError if the folder cannot be written, or `overwrite` is not given and another program wrote into
  /// it; nothing is lost.
  void save(bool overwrite = false);

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

  /// How the stages stand; kept until the next change, because it hashes their inputs.
  const StageStatus& statusOf(Stage stage) const;
  StageState stateOf(Stage stage) const { return statusOf(stage).state; }
  const std::filesystem::path& resourceDir() const { return resource_dir_; }

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
  std::string stored_text_;  ///< of case.json as last seen
  std::filesystem::path folder_;
  bool modified_ = false;
  std::filesystem::path resource_dir_;
  mutable std::vector<StageStatus> status_;  ///< empty: to be asked again
};

}  // namespace sinew
