#include "app/widgets/shell/banner.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QTimer>
#include <QToolButton>

#include "app/widgets/controls/theme.h"

namespace sinew {

Banner::Banner(QWidget* parent) : QFrame{parent} {
  setObjectName("banner");
  setProperty("banner", "error");
  sign_ = new QLabel;
  text_ = new QLabel;
  text_->setObjectName("banner_text");
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = makeToolButton("banner_close", "close", tr("Close message"), this);
  close->setProperty("role", "flat");
  auto* row = new QHBoxLayout{this};
  row->setContentsMargins(12, 4, 6, 4);
  row->addWidget(sign_);
  row->addWidget(text_, 1);
  row->addWidget(close);
  timer_ = new QTimer{this};
  timer_->setSingleShot(true);
  timer_->setInterval(5000);
  connect(timer_, &QTimer::timeout, this, &QWidget::hide);
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  hide();
}

void Banner::showProblem(const QString& message) {
  timer_->stop();
  showLine("error", "error", colour::kDanger, message);
}

void Banner::showNotice(const QString& message) {
  if (isVisible() && property("banner") == "error") return;  // a notice does not push a problem away
  showLine("info", "info", colour::kPrimary, message);
  timer_->start();
}

void Banner::showLine(const char* kind, const char* sign, const QColor& color, const QString& message) {
  setRole(this, "banner", kind);
  sign_->setPixmap(icon(sign, color).pixmap(18, 18));
  text_->setText(message);
  setAccessibleName(message);
  show();
}

}  // namespace sinew
