#include "core/skeleton/fit/exchange_words_internal.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace sinew {
namespace {

using Chosen = std::function<bool(const NamedPair&)>;

std::string readable(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string viewsText(const std::set<int>& views, int view_count) {
  if (view_count > 1 && int(views.size()) == view_count) return view_count == 2 ? "both views" : "all views";
  std::string text;
  for (const int view : views) text += (text.empty() ? "view " : " and view ") + std::to_string(view + 1);
  return text;
}

class Wording {
 public:
  Wording(const std::vector<NamedPair>& pairs, const std::vector<PairVerdict>& verdicts,
          const std::vector<bool>& swapped, int view_count)
      : pairs_{pairs}, verdicts_{verdicts}, swapped_{swapped}, view_count_{view_count}, open_(pairs.size(), true) {}

  ExchangeWords make() {
    takeViews();
    takeBones();
    takeLandmarks();
    return std::move(words_);
  }

 private:
  /// Whether the chosen pairs are exchanged as a whole.
  bool isWhole(const Chosen& chosen, int least) const {
    int sure = 0;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      if (!chosen(pairs_[p])) continue;
      if (verdicts_[p] == PairVerdict::AsNamed) return false;
      sure += verdicts_[p] == PairVerdict::Exchanged;
    }
    return sure >= least;
  }

  void take(const Chosen& chosen, bool whole) {
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      if (!open_[p] || !chosen(pairs_[p])) continue;
      open_[p] = false;
      auto at = std::ranges::find_if(
          words_.exchanges, [&](const SideExchange& e) { return e.view == pairs_[p].view && e.whole == whole; });
      if (at == words_.exchanges.end()) at = words_.exchanges.insert(at, {pairs_[p].view, {}, whole});
      at->landmarks.push_back(pairs_[p].landmark);
    }
  }

  void say(const std::string& text) { words_.what += (words_.what.empty() ? "" : "; ") + text; }

  void takeViews() {
    std::set<int> views;
    for (int view = 0; view < view_count_; ++view) {
      const Chosen in_view = [view](const NamedPair& p) { return p.view == view; };
      std::set<std::string> bones;
      for (const auto& p : pairs_)
        if (in_view(p)) bones.insert(p.bone);
      if (bones.size() < 2 || !isWhole(in_view, 3)) continue;
      views.insert(view);
      take(in_view, true);
    }
    if (!views.empty()) say("all landmarks of " + viewsText(views, view_count_));
  }

  void takeBones() {
    std::map<std::string, std::set<int>> of_bone;
    for (const auto& pair : pairs_) {
      const Chosen same = [&](const NamedPair& p) { return p.view == pair.view && p.bone == pair.bone; };
      const auto open = [&](std::size_t p) { return open_[p] && same(pairs_[p]); };
      bool any = false;
      for (std::size_t p = 0; p < pairs_.size(); ++p) any |= open(p);
      if (!any || !isWhole(same, 2)) continue;
      of_bone[pair.bone].insert(pair.view);
      take(same, true);
    }
    for (const auto& [bone, views] : of_bone) say(readable(bone) + " in " + viewsText(views, view_count_));
  }

  void takeLandmarks() {
    std::map<std::string, std::set<int>> of_landmark;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      if (!open_[p] || !swapped_[p] || verdicts_[p] != PairVerdict::Exchanged) continue;
      const NamedPair& pair = pairs_[p];
      of_landmark[pair.landmark].insert(pair.view);
      take([&](const NamedPair& other) { return other.view == pair.view && other.landmark == pair.landmark; }, false);
    }
    for (const auto& [landmark, views] : of_landmark)
      say(readable(landmark) + " in " + viewsText(views, view_count_));
  }

  const std::vector<NamedPair>& pairs_;
  const std::vector<PairVerdict>& verdicts_;
  const std::vector<bool>& swapped_;
  int view_count_;
  std::vector<bool> open_;
  ExchangeWords words_;
};

}  // namespace

ExchangeWords wordsFor(const std::vector<NamedPair>& pairs, const std::vector<PairVerdict>& verdicts,
                       const std::vector<bool>& swapped, int view_count) {
  return Wording{pairs, verdicts, swapped, view_count}.make();
}

}  // namespace sinew
