#include "core/undo_history.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TEST(UndoHistory, StepsBackAndForwardAndForgetsTheBranch) {
  UndoHistory<int> history{0};
  history.commit("one", 1);
  history.commit("two", 2);
  EXPECT_EQ(history.undoLabel(), "two");
  history.undo();
  EXPECT_EQ(history.current(), 1);
  EXPECT_EQ(history.redoLabel(), "two");
  history.commit("three", 3);
  EXPECT_FALSE(history.canRedo());
  history.undo();
  history.undo();
  EXPECT_EQ(history.current(), 0);
  EXPECT_THROW(history.undo(), std::logic_error);
}

}  // namespace
}  // namespace sinew
