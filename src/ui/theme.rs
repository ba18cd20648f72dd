//! Colours, sizes and fonts: the only file that names a colour.

use std::sync::Arc;

use eframe::egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Rgba,
    Shadow, Stroke, Style, TextStyle, Theme, Ui, Vec2, Visuals, style::ScrollStyle,
    style::Selection, style::TextCursorStyle, style::WidgetVisuals, style::Widgets,
};

use crate::document::{Colour, CurveId};

/// The step that all distances are multiples of, in points.
pub const STEP: f32 = 4.0;

/// The radius of rounded corners.
pub const RADIUS: u8 = 4;

/// The height of a row: buttons, fields, lines of a list.
pub const ROW: f32 = 24.0;

/// The size of an icon.
pub const ICON: f32 = 16.0;

/// The name of the icons' font family.
const ICON_FAMILY: &str = "icons";

/// The least contrast of a curve with the canvas.
const LEAST_CONTRAST: f64 = 3.0;

/// The colours of one theme, by purpose.
#[derive(Clone, Debug, PartialEq)]
pub struct Tokens {
    /// The canvas.
    pub background: Color32,
    /// Panels, menus and bars.
    pub panel: Color32,
    /// Text fields and plots, set into a panel.
    pub inset: Color32,
    /// Lines between panels, outlines of fields.
    pub outline: Color32,
    /// Text.
    pub text: Color32,
    /// Captions, hints and units.
    pub faint_text: Color32,
    /// Headings and selected items.
    pub strong_text: Color32,
    /// A button at rest, hovered and pressed.
    pub button: [Color32; 3],
    /// Behind selected items.
    pub selection: Color32,
    /// Keyboard focus, links.
    pub accent: Color32,
    /// The grid's minor lines.
    pub grid_minor: Color32,
    /// The grid's major lines.
    pub grid_major: Color32,
    /// The axes.
    pub axes: Color32,
    /// The axes of the model: x, y, z.
    pub model_axes: [Color32; 3],
    /// The curve.
    pub curve: Color32,
    /// The colours of the curves and references of a document, one after the other: the first is the curve's.
    /// All are apart from each other, from the float S-polygon and from the comb, for the colour-blind too.
    pub items: [Color32; 8],
    /// Pieces of the curve on which curvature is proved to rise.
    pub rising: Color32,
    /// Pieces of the curve on which curvature is proved to fall.
    pub falling: Color32,
    /// Pieces of the curve of which nothing is proved.
    pub undecided: Color32,
    /// The float S-polygon.
    pub float: Color32,
    /// The closed S-polygon.
    pub clamped: Color32,
    /// The joints between segments.
    pub joints: Color32,
    /// Guides.
    pub guide: Color32,
    /// References: quieter than curves.
    pub reference: Color32,
    /// The evolute.
    pub evolute: Color32,
    /// The curvature comb, its envelope.
    pub comb: Color32,
    /// Target points and directions.
    pub target: Color32,
    /// Within tolerance.
    pub good: Color32,
    /// Outside tolerance.
    pub warning: Color32,
    /// What failed.
    pub error: Color32,
    /// Behind a dialog.
    pub veil: Color32,
    /// Under a popup.
    pub shadow: Color32,
}

/// The colours that are offered for curves: apart for the colour-blind too, legible on both
/// backgrounds.
pub const CURVE_COLOURS: [(&str, Colour); 8] = [
    ("Blue", Colour([0x3B, 0x82, 0xD6])),
    ("Sky", Colour([0x2C, 0x9F, 0xC4])),
    ("Green", Colour([0x1F, 0x9D, 0x6E])),
    ("Olive", Colour([0x8A, 0x8F, 0x1E])),
    ("Ochre", Colour([0xB9, 0x82, 0x0F])),
    ("Vermilion", Colour([0xD5, 0x5E, 0x2A])),
    ("Rose", Colour([0xCF, 0x4F, 0x8F])),
    ("Violet", Colour([0x8B, 0x6F, 0xDB])),
];

/// One of two colours: that of the dark theme, or that of the light one.
const fn pick(dark: bool, [of_dark, of_light]: [u32; 2]) -> Color32 {
    let hex = if dark { of_dark } else { of_light };
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

static DARK: Tokens = Tokens::new(true);
static LIGHT: Tokens = Tokens::new(false);

impl Tokens {
    /// The table of colours: in the dark theme, in the light theme.
    const fn new(dark: bool) -> Self {
        let comb = pick(dark, [0x5B9BF5, 0x2F6FD0]);
        Self {
            background: pick(dark, [0x14161A, 0xFBFBFA]),
            panel: pick(dark, [0x1B1E24, 0xF1F1EF]),
            inset: pick(dark, [0x14161A, 0xFBFBFA]),
            outline: pick(dark, [0x2E333D, 0xD3D3CE]),
            text: pick(dark, [0xD3D8E2, 0x2A2E35]),
            faint_text: pick(dark, [0x98A1B0, 0x5A616D]),
            strong_text: pick(dark, [0xF4F6FA, 0x0C0E11]),
            button: [
                pick(dark, [0x282D36, 0xE3E3DF]),
                pick(dark, [0x333945, 0xD8D8D3]),
                pick(dark, [0x3D4452, 0xCBCBC5]),
            ],
            selection: pick(dark, [0x23406A, 0xCBDDF8]),
            accent: pick(dark, [0x5B9BF5, 0x2F6FD0]),
            grid_minor: pick(dark, [0x1E2127, 0xEFEFEC]),
            grid_major: pick(dark, [0x272B33, 0xE2E2DE]),
            axes: pick(dark, [0x3A404B, 0xC9C9C3]),
            model_axes: [
                pick(dark, [0xE5716B, 0xBF3B34]),
                pick(dark, [0x6CBF5B, 0x3D8A2B]),
                pick(dark, [0x6A9CF0, 0x2F62C4]),
            ],
            curve: pick(dark, [0xF4F6FA, 0x14161A]),
            // A curve has much the same hue in both themes.
            items: [
                pick(dark, [0xF4F6FA, 0x14161A]),
                pick(dark, [0xB3FF98, 0x0B5600]),
                pick(dark, [0x9C5D93, 0x6C0574]),
                pick(dark, [0xAFA464, 0x978847]),
                pick(dark, [0xFEB5FF, 0x9E10FA]),
                pick(dark, [0x06825D, 0x05A37B]),
                pick(dark, [0x99B7A8, 0x8889A9]),
                pick(dark, [0x647B00, 0x4F4B35]),
            ],
            rising: pick(dark, [0x34D399, 0x0E9F6E]),
            falling: pick(dark, [0x38BDF8, 0x0369A1]),
            undecided: pick(dark, [0x9CA3AF, 0x6B7280]),
            float: pick(dark, [0xF5A524, 0xC27803]),
            clamped: pick(dark, [0x2DD4BF, 0x0F8F80]),
            joints: pick(dark, [0x94A3B8, 0x64748B]),
            guide: pick(dark, [0x3A8FA3, 0x2B8A9E]),
            reference: pick(dark, [0x94A3B8, 0x64748B]),
            evolute: pick(dark, [0xA78BFA, 0x6D4AE0]),
            comb,
            target: pick(dark, [0xF472B6, 0xC2257A]),
            good: pick(dark, [0x34D399, 0x0E7A55]),
            warning: pick(dark, [0xFB923C, 0xB04E08]),
            error: pick(dark, [0xF87171, 0xC81E1E]),
            veil: Color32::from_black_alpha(if dark { 120 } else { 70 }),
            shadow: Color32::from_black_alpha(if dark { 96 } else { 28 }),
        }
    }

    /// The colours of the theme that a panel is painted in.
    pub fn of(ui: &Ui) -> &'static Self {
        Self::of_theme(ui.visuals().dark_mode)
    }

    /// The colours of the dark or the light theme.
    pub fn of_theme(dark: bool) -> &'static Self {
        if dark { &DARK } else { &LIGHT }
    }

    /// The colour that a row of the table of layers names.
    pub fn named(&self, name: &str) -> Color32 {
        match name {
            "float" => self.float,
            "clamped" => self.clamped,
            "curve" => self.curve,
            "evolute" => self.evolute,
            "comb" => self.comb,
            "target" => self.target,
            "joints" => self.joints,
            "guide" => self.guide,
            "rising" => self.rising,
            "good" => self.good,
            _ => self.text,
        }
    }

    /// The colour of a curve or reference: its own, or else the next for each one that is added. That of a
    /// reference is quieter if it is the first.
    pub fn of_item(&self, id: Option<CurveId>, own: Option<Colour>, is_reference: bool) -> Color32 {
        let place = id.map_or(0, |id| id.number() % self.items.len() as u64);
        match own {
            Some(own) => self.on_canvas(of_document(own)),
            None if is_reference && place == 0 => self.reference,
            None => self.items[place as usize],
        }
    }

    /// A colour of the document as it is drawn: one that is hardly seen on the canvas comes nearer to that of text.
    fn on_canvas(&self, colour: Color32) -> Color32 {
        let steps = (0..=10_u8).map(|step| colour.lerp_to_gamma(self.text, f32::from(step) / 10.0));
        let mut seen = steps.filter(|it| contrast(*it, self.background) >= LEAST_CONTRAST);
        seen.next().unwrap_or(self.text)
    }

    fn visuals(&self, dark: bool) -> Visuals {
        let base = if dark {
            Visuals::dark()
        } else {
            Visuals::light()
        };
        Visuals {
            widgets: self.widgets(),
            selection: Selection {
                bg_fill: self.selection,
                stroke: Stroke::new(1.0, self.strong_text),
            },
            weak_text_color: Some(self.faint_text),
            hyperlink_color: self.accent,
            faint_bg_color: self.button[0].gamma_multiply(0.4),
            extreme_bg_color: self.inset,
            code_bg_color: self.inset,
            warn_fg_color: self.warning,
            error_fg_color: self.error,
            window_corner_radius: CornerRadius::same(2 * RADIUS),
            menu_corner_radius: CornerRadius::same(RADIUS),
            window_fill: self.panel,
            panel_fill: self.panel,
            window_stroke: Stroke::new(1.0, self.outline),
            window_shadow: self.drop_shadow(),
            popup_shadow: self.drop_shadow(),
            text_cursor: TextCursorStyle {
                stroke: Stroke::new(1.5, self.accent),
                blink: false,
                ..TextCursorStyle::default()
            },
            slider_trailing_fill: true,
            disabled_alpha: 0.45,
            ..base
        }
    }

    fn drop_shadow(&self) -> Shadow {
        Shadow {
            offset: [0, 4],
            blur: 16,
            spread: 0,
            color: self.shadow,
        }
    }

    fn widgets(&self) -> Widgets {
        let [rest, hovered, pressed] = self.button;
        let look = |fill: Color32, outline: Stroke, text: Color32| WidgetVisuals {
            bg_fill: fill,
            weak_bg_fill: fill,
            bg_stroke: outline,
            corner_radius: CornerRadius::same(RADIUS),
            fg_stroke: Stroke::new(1.0, text),
            expansion: 0.0,
        };
        let outline = Stroke::new(1.0, self.outline);
        Widgets {
            noninteractive: look(self.panel, outline, self.text),
            inactive: look(rest, Stroke::NONE, self.text),
            hovered: look(hovered, Stroke::NONE, self.strong_text),
            active: look(pressed, Stroke::new(1.0, self.accent), self.strong_text),
            open: look(hovered, Stroke::NONE, self.strong_text),
        }
    }
}

/// Give a context the fonts and both themes.
pub fn install(context: &Context) {
    context.set_fonts(fonts());
    for theme in [Theme::Dark, Theme::Light] {
        context.set_style_of(theme, style(theme == Theme::Dark));
    }
}

/// Choose the dark or the light theme.
pub fn choose(context: &Context, dark: bool) {
    context.set_theme(if dark { Theme::Dark } else { Theme::Light });
}

/// The contrast of two colours, from 1 to 21: the ratio of their luminances, each with the light of a room (WCAG 2).
fn contrast(a: Color32, b: Color32) -> f64 {
    let [a, b] = [a, b].map(|colour| luminance(light(colour)) + 0.05);
    a.max(b) / a.min(b)
}

/// How much red, green and blue light a colour is.
fn light(colour: Color32) -> [f64; 3] {
    let [red, green, blue, _] = Rgba::from(colour).to_array();
    [red, green, blue].map(f64::from)
}

fn luminance([red, green, blue]: [f64; 3]) -> f64 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// A colour that the user gave to a curve.
pub fn of_document(colour: Colour) -> Color32 {
    let [red, green, blue] = colour.0;
    Color32::from_rgb(red, green, blue)
}

/// The font of icons.
pub fn icon_font(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(ICON_FAMILY.into()))
}

/// The font of numbers: every figure as wide as the next.
pub fn number_font() -> FontId {
    FontId::monospace(12.0)
}

/// The font of small captions.
pub fn small_font() -> FontId {
    FontId::proportional(11.0)
}

fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    let lucide = FontData::from_static(lucide_icons::LUCIDE_FONT_BYTES);
    let name = ICON_FAMILY.to_owned();
    fonts.font_data.insert(name.clone(), Arc::new(lucide));
    let family = FontFamily::Name(ICON_FAMILY.into());
    fonts.families.insert(family, vec![name]);
    fonts
}

fn style(dark: bool) -> Style {
    let mut style = Style {
        visuals: Tokens::of_theme(dark).visuals(dark),
        animation_time: 0.1,
        drag_value_text_style: TextStyle::Monospace,
        ..Style::default()
    };
    style.text_styles = [
        (TextStyle::Small, small_font()),
        (TextStyle::Body, FontId::proportional(13.0)),
        (TextStyle::Button, FontId::proportional(13.0)),
        (TextStyle::Heading, FontId::proportional(13.0)),
        (TextStyle::Monospace, number_font()),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = Vec2::new(2.0 * STEP, STEP);
    spacing.button_padding = Vec2::new(2.0 * STEP, STEP);
    spacing.interact_size = Vec2::new(10.0 * STEP, ROW);
    spacing.window_margin = Margin::same(16);
    spacing.menu_margin = Margin::same(4);
    spacing.menu_spacing = STEP;
    spacing.icon_width = 16.0;
    spacing.icon_spacing = 6.0;
    spacing.tooltip_width = 320.0;
    spacing.combo_height = 320.0;
    spacing.scroll = ScrollStyle {
        bar_width: 8.0,
        // Beside the contents, never over their numbers.
        floating_allocated_width: 12.0,
        bar_outer_margin: 2.0,
        // At rest it shows that there is more to see.
        dormant_handle_opacity: 0.4,
        ..ScrollStyle::floating()
    };
    style.interaction.selectable_labels = false;
    style.interaction.tooltip_delay = 0.4;
    style
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear light, red to blue.
    type Light = [f64; 3];

    /// Linear light as seen without one kind of cones (Machado, Oliveira and Fernandes 2009): long,
    /// middle, short; and every eye.
    const EYES: [[Light; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ],
    ];

    fn seen(by: &[Light; 3], colour: Color32) -> Light {
        let light = light(colour);
        by.map(|row| {
            let sum: f64 = row
                .iter()
                .zip(light)
                .map(|(share, light)| share * light)
                .sum();
            sum.clamp(0.0, 1.0)
        })
    }

    /// The CIE 1976 distance of two lights under D65.
    fn distance(a: Light, b: Light) -> f64 {
        let lab = |light: Light| {
            let [red, green, blue] = light;
            let x = (0.4124 * red + 0.3576 * green + 0.1805 * blue) / 0.9505;
            let z = (0.0193 * red + 0.1192 * green + 0.9505 * blue) / 1.089;
            let [x, y, z] = [x, luminance(light), z].map(|t: f64| match t > 0.008856 {
                true => t.cbrt(),
                false => 7.787 * t + 16.0 / 116.0,
            });
            [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
        };
        let squares = lab(a)
            .into_iter()
            .zip(lab(b))
            .map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>().sqrt()
    }

    #[test]
    fn colours_of_documents_are_seen_on_both_canvases() {
        for tokens in [true, false].map(Tokens::of_theme) {
            for own in [[0; 3], [255; 3], [0, 0, 255], [255, 255, 0], [128, 0, 0]] {
                let drawn = tokens.of_item(None, Some(Colour(own)), false);
                assert!(
                    contrast(drawn, tokens.background) >= LEAST_CONTRAST,
                    "{own:?}"
                );
            }
            let clear = Colour([255, 0, 0]);
            assert_eq!(tokens.of_item(None, Some(clear), false), of_document(clear));
        }
    }

    #[test]
    fn the_colours_of_curves_stand_out_from_both_canvases() {
        for tokens in [&DARK, &LIGHT] {
            for colour in tokens.items {
                let contrast = contrast(colour, tokens.background);
                assert!(contrast >= LEAST_CONTRAST, "{colour:?}: {contrast}");
            }
        }
    }

    #[test]
    fn the_colours_of_curves_are_apart_for_every_eye() {
        for tokens in [&DARK, &LIGHT] {
            for eye in &EYES {
                for (index, a) in tokens.items.iter().enumerate() {
                    for b in &tokens.items[index + 1..] {
                        let distance = distance(seen(eye, *a), seen(eye, *b));
                        assert!(distance > 20.0, "{a:?} and {b:?}: {distance}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_colours_of_curves_are_apart_from_those_of_polygon_and_comb() {
        for tokens in [&DARK, &LIGHT] {
            for (eye, least) in EYES.iter().zip([36.0, 20.0, 20.0, 20.0]) {
                for a in tokens.items {
                    for b in [tokens.float, tokens.comb] {
                        let distance = distance(seen(eye, a), seen(eye, b));
                        assert!(distance > least, "{a:?} and {b:?}: {distance}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_curve_is_the_brightest_of_what_is_drawn_along_it() {
        for tokens in [&DARK, &LIGHT] {
            let curve = contrast(tokens.curve, tokens.background);
            for other in [
                tokens.float,
                tokens.clamped,
                tokens.joints,
                tokens.evolute,
                tokens.comb,
                tokens.rising,
                tokens.falling,
                tokens.reference,
            ] {
                let other = contrast(other, tokens.background);
                assert!(curve > 1.5 * other, "{curve} against {other}");
            }
        }
    }
}
