#include "app/model/retarget/retarget_design.h"

#include "core/error.h"

namespace sinew {

DesignDocument::DesignDocument(QObject* parent) : QObject{parent} {}

bool DesignDocument::edit(const QString& label, const std::function<void(RetargetDesign&)>& change) {
  RetargetDesign next = history_.current();
  const bool dragged = preview_.has_value();
  preview_.reset();
  try {
    change(next);
    validate(next.body.shape);
  } catch (const InputError& error) {
    if (dragged) emit previewed();
    emit rejected(QString::fromUtf8(error.what()));
    return false;
  }
  if (next == history_.current()) {
    if (dragged) emit previewed();
    return false;
  }
  history_.commit(label.toStdString(), std::move(next));
  emit changed();
  return true;
}

void DesignDocument::preview(const std::function<void(RetargetDesign&)>& change) {
  RetargetDesign next = history_.current();
  try {
    change(next);
    validate(next.body.shape);
  } catch (const InputError& error) {
    emit rejected(QString::fromUtf8(error.what()));
    return;
  }
  if (next == current()) return;
  preview_ = std::move(next);
  emit previewed();
}

void DesignDocument::dropPreview() {
  if (!preview_) return;
  preview_.reset();
  emit previewed();
}

void DesignDocument::reset(RetargetDesign design) {
  preview_.reset();
  if (design == history_.current() && !history_.canUndo() && !history_.canRedo()) return;
  history_ = UndoHistory<RetargetDesign>{std::move(design)};
  emit changed();
}

void DesignDocument::undo() {
  preview_.reset();
  if (!history_.canUndo()) return;
  history_.undo();
  emit changed();
}

void DesignDocument::redo() {
  preview_.reset();
  if (!history_.canRedo()) return;
  history_.redo();
  emit changed();
}

}  // namespace sinew
