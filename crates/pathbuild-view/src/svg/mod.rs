//! Scenes as SVG: deterministic output, light for printing, in colours that the colour-blind can distinguish.

mod canvas;
mod changes;
mod cutout;
mod frame;
mod legend;
mod marks;
mod moves;
mod palette;
mod room;
mod sheet;
mod things;

use pathbuild_diagnostic::Lang;

use crate::scene::Scene;
use canvas::Canvas;
pub use canvas::escaped;
pub use changes::{Picture, changes_svg};
pub use cutout::{Spot, cutout_svg};
use frame::Frame;
use palette::Depths;
use room::Room;
#[cfg(not(feature = "pictures"))]
pub use sheet::sheet_pdf;
#[cfg(feature = "pictures")]
pub(crate) use sheet::xmp;
pub use sheet::{Sheet, SheetProbe, SheetTool, sheet_html, sheet_pages, sheet_svg};

/// The visible parts of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a layer of its own")]
pub struct VisibleParts {
    /// Language of the legend and the findings.
    pub lang: Lang,
    /// Whether to show rapid moves.
    pub rapids: bool,
    /// Whether to show the cutting order.
    pub order: bool,
    /// Whether to show arrows.
    pub arrows: bool,
    /// Whether to show parameter texts.
    pub texts: bool,
}

impl VisibleParts {
    /// Shows everything.
    pub fn all(lang: Lang) -> Self {
        Self { lang, rapids: true, order: true, arrows: true, texts: true }
    }

    fn either(self, en: &'static str, de: &'static str) -> &'static str {
        self.lang.choose(en, de)
    }
}

/// Draws a scene.
pub fn svg(scene: &Scene, shown: VisibleParts) -> String {
    let frame = Frame::of(scene);
    let depths = Depths::of(scene);
    let legend = legend::Legend::new(scene, &frame, &depths, shown);
    let mut canvas = Canvas::new(Frame::WIDTH, legend.bottom());
    canvas.title(&scene.title);
    canvas.open("id=\"drawing\" clip-path=\"url(#frame)\"");
    canvas.clip("frame", frame.area());
    let mut room = Room::new(frame.area());
    things::under(&mut canvas, scene, &frame, &mut room);
    for path in &scene.paths {
        let place = frame.of_path(path);
        moves::draw(&mut canvas, path, &place, &depths, shown);
        marks::reserve(path, &place, &mut room);
        things::over(&mut canvas, path, &place, shown, &mut room);
    }
    marks::findings(&mut canvas, scene, &frame, &mut room);
    canvas.close();
    legend.draw(&mut canvas);
    canvas.finish()
}
