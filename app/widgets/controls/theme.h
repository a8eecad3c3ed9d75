#pragma once
#include <QColor>
#include <QIcon>
#include <QString>
#include <filesystem>

class QApplication;
class QLabel;
class QToolButton;
class QWidget;

namespace sinew {

/// The window's colours. Text on its background has a contrast of at least 4.5 : 1 (WCAG 2.1 AA).
namespace colour {
inline const QColor kInk{0x1b, 0x27, 0x31}, kText{0x1b, 0x27, 0x31}, kMuted{0x56, 0x66, 0x74};
inline const QColor kBackground{0xf3, 0xf5, 0xf8}, kSurface{0xff, 0xff, 0xff}, kLine{0xe0, 0xe5, 0xea},
    kBorder{0xc3, 0xcc, 0xd5};
inline const QColor kPrimary{0x0b, 0x6b, 0x8c}, kPrimaryDark{0x08, 0x52, 0x6c}, kSelection{0xdc, 0xee, 0xf4};
inline const QColor kSuccess{0x1b, 0x6e, 0x45}, kWarning{0x85, 0x57, 0x00}, kDanger{0xa8, 0x26, 0x1c};
inline const QColor kSuccessTint{0xdf, 0xf3, 0xe7}, kWarningTint{0xfd, 0xf1, 0xd3}, kDangerTint{0xfb, 0xe4, 0xe1};
inline const QColor kView{0x0a, 0x0f, 0x14}, kViewStrip{0x17, 0x21, 0x2a}, kViewText{0xdf, 0xe7, 0xee};
// Sides and marks, apart for colour-blind readers (Okabe & Ito 2008).
inline const QColor kRight{0xf0, 0xa0, 0x30}, kLeft{0x56, 0xb4, 0xe9}, kMidline{0x2c, 0xc7, 0x9a},
    kSelected{0xf0, 0xe4, 0x42}, kEpipolar{0xe3, 0x8f, 0xc6};
}  // namespace colour

/// Fonts, style sheet and icon folder for the whole application. Call once, after QApplication.
/// @throws InputError if the style sheet is not in the resource folder.
void installTheme(QApplication& application, const std::filesystem::path& resource_dir);

/// A line icon of resources/icons in one colour, sharp at any scale.
QIcon icon(const QString& name, const QColor& color = colour::kText);

/// Colour of a landmark or bone by its side.
QColor sideColour(std::string_view name);

/// Sets a style property and lets the style sheet look again.
void setRole(QWidget* widget, const char* property, const QVariant& value);

QLabel* makeLabel(const QString& text, const char* role, QWidget* parent = nullptr);
/// A square button with icon, tooltip and accessible name.
QToolButton* makeToolButton(const QString& object_name, const QString& icon_name, const QString& tip,
                            QWidget* parent = nullptr, const QColor& color = colour::kText);

}  // namespace sinew
