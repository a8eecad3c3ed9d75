#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace sinew {

/// Undo by snapshots of a value. Heavy parts of T are shared_ptr<const ...>, so that a snapshot is cheap.
template <class T>
class UndoHistory {
 public:
  explicit UndoHistory(T initial) { steps_.push_back({"", std::move(initial)}); }

  const T& current() const { return steps_[position_].value; }

  /// Makes `next` the current value as one step named `label`; what was undone before is dropped.
  void commit(std::string label, T next) {
    steps_.resize(position_ + 1, steps_.front());
    steps_.push_back({std::move(label), std::move(next)});
    ++position_;
  }
  bool canUndo() const { return position_ > 0; }
  bool canRedo() const { return position_ + 1 < steps_.size(); }
  /// Label of the step that undo() takes back, or redo() repeats; empty if there is none.
  std::string undoLabel() const { return canUndo() ? steps_[position_].label : std::string{}; }
  std::string redoLabel() const { return canRedo() ? steps_[position_ + 1].label : std::string{}; }
  void undo() {
    require(canUndo(), "nothing to undo");
    --position_;
  }
  void redo() {
    require(canRedo(), "nothing to redo");
    ++position_;
  }

 private:
  struct Step {
    std::string label;
    T value;
  };
  std::vector<Step> steps_;
  std::size_t position_ = 0;
};

}  // namespace sinew
