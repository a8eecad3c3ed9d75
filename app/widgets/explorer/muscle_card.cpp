#include "app/widgets/explorer/muscle_card.h"

#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>

#include "app/model/explorer/explorer.h"
#include "app/model/explorer/muscle_text.h"
#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"

namespace sinew {
namespace {

QString html(const std::vector<CardSection>& sections) {
  constexpr int kLongValue = 18;  // characters: longer ones stand below their label
  QString text;
  for (const auto& section : sections) {
    text += QStringLiteral(
                "<p style='margin-top:10px; margin-bottom:2px'><b>%1</b></p><table width='100%' cellspacing='0' "
                "cellpadding='1'>")
                .arg(section.heading.toHtmlEscaped());
    for (const auto& [label, value] : section.lines) {
      const QString l = label.toHtmlEscaped(), v = value.toHtmlEscaped();
      const QString muted = "<span style='color:" + colour::kMuted.name() + "'>";
      if (label.isEmpty())
        text += "<tr><td colspan='2'>" + v + "</td></tr>";
      else if (value.size() > kLongValue)
        text += "<tr><td colspan='2'>" + muted + l + "</span><br>" + v + "</td></tr>";
      else
        text +=
            "<tr><td>" + muted + l + "</span></td><td align='right' style='white-space:nowrap'>" + v + "</td></tr>";
    }
    text += "</table>";
  }
  return text;
}

}  // namespace

MuscleCard::MuscleCard(Explorer& explorer, QWidget* parent) : QWidget{parent}, explorer_{explorer} {
  setObjectName("muscle_card");
  title_ = makeLabel({}, "heading");
  title_->setObjectName("card_title");
  title_->setWordWrap(true);
  subtitle_ = makeLabel({}, "small");
  subtitle_->setObjectName("card_subtitle");
  subtitle_->setWordWrap(true);
  facts_ = new QLabel;
  facts_->setObjectName("card_facts");
  facts_->setTextFormat(Qt::RichText);
  facts_->setWordWrap(true);
  facts_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  facts_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  facts_->setContentsMargins(0, 0, 10, 8);
  scroll_ = new QScrollArea;
  scroll_->setWidget(facts_);
  scroll_->setWidgetResizable(true);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(14, 12, 4, 4);
  column->setSpacing(2);
  column->addWidget(title_);
  column->addWidget(subtitle_);
  column->addSpacing(6);
  column->addWidget(scroll_, 1);
}

void MuscleCard::refresh() {
  const int unit = explorer_.muscleIndex();
  if (unit < 0) {
    title_->setText(tr("No muscle chosen"));
    subtitle_->setText(tr("Click one in the model, or find it in the list."));
    facts_->clear();
    return;
  }
  const auto& u = explorer_.model()->musculature.units[std::size_t(unit)];
  title_->setText(readableName(u.name));
  subtitle_->setText(tr("Group: %1").arg(readableName(u.group)));
  facts_->setText(html(muscleCard(explorer_, unit)));
}

}  // namespace sinew
