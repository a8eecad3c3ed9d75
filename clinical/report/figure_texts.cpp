#include "clinical/report/figure_texts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "clinical/report/report_tables.h"

namespace sinew {
namespace {

std::string named(const std::string& quantity, const std::string& side, const NormTable& norms) {
  const std::string title = norms.textOf(quantity).title;
  return side == "r" ? title + " right" : side == "l" ? title + " left" : title;
}

std::string lowerFirst(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

}  // namespace

std::string nameInWords(const BoneFigure& figure, const NormTable& norms) {
  return named(figure.quantity, figure.side, norms);
}

std::vector<std::string> triangulatedTexts(const std::vector<BoneFigure>& figures, const NormTable& norms) {
  std::vector<std::string> texts;
  for (const BoneFigure& f : figures)
    if (f.triangulated)
      texts.push_back(nameInWords(f, norms) + ": " + numberText(f.value, 1) + " " + f.unit +
                      " from the picks themselves (triangulated), " + numberText(f.other, 1) + " (" +
                      numberText(f.other_lower95, 1) + " to " + numberText(f.other_upper95, 1) +
                      ") by the fitted bone");
  return texts;
}

std::vector<std::string> adviceTexts(const std::vector<FigureAdvice>& advice, const NormTable& norms,
                                     const std::vector<ProtocolLandmark>& protocol) {
  struct Group {
    std::vector<std::string> landmarks;
    bool enough = false;
    std::vector<std::string> figures;
  };
  std::vector<Group> groups;
  for (const FigureAdvice& a : advice) {
    const auto same = std::ranges::find_if(
        groups, [&](const Group& g) { return g.landmarks == a.landmarks && g.enough == a.enough; });
    Group& group = same == groups.end() ? groups.emplace_back(Group{a.landmarks, a.enough, {}}) : *same;
    const std::string name = named(a.quantity, a.side, norms);
    group.figures.push_back(group.figures.empty() ? name : lowerFirst(name));
  }
  std::ranges::stable_sort(groups, {}, [](const Group& g) { return std::pair{!g.enough, g.landmarks.size()}; });
  std::vector<std::string> texts;
  for (const Group& group : groups) {
    std::vector<std::string> titles;
    for (const auto& landmark : group.landmarks) {
      const auto at = std::ranges::find(protocol, landmark, &ProtocolLandmark::name);
      titles.push_back(at == protocol.end() ? landmark : lowerFirst(at->title));
    }
    const std::string figures = joined(group.figures);
    if (titles.empty())
      texts.push_back(figures + ": no further landmark determines it");
    else
      texts.push_back(figures + (group.enough ? ": pick " : ": helped, but not determined, by ") + joined(titles));
  }
  return texts;
}

}  // namespace sinew
