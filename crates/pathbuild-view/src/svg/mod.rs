//! Scenes as SVG. The output is deterministic, suitable for printing, and uses colours that the colour-blind can distinguish.

mod canvas;
mod changes;
mod cutout;
mod frame;
mod legend;
mod moves;
mod sheet;
mod stock;
mod symbols;

use crate::scene::Scene;
pub use canvas::escaped;
use canvas::{Canvas, Depths};
pub use changes::{Picture, changes_svg};
pub use cutout::{FindingPlace, cutout_svg, stock_cutout_svg};
pub use frame::VisibleParts;
use frame::{Frame, OccupiedSpace};
#[cfg(not(feature = "pictures"))]
pub use sheet::sheet_pdf;
pub use sheet::{Sheet, SheetProbe, SheetTool, sheet_html, sheet_svg};
#[cfg(feature = "pictures")]
pub(crate) use sheet::{sheet_pages, xmp};
use stock::MilledStock;
pub use stock::{StockChange, has_stock, stock_change_svg};

/// Draws a scene: the drawing and its moves, or the stock after all moves. If the stock is unknown, its picture has only a legend and the findings.
pub fn svg(scene: &Scene, shown: VisibleParts) -> String {
    let stock = shown.stock.then(|| MilledStock::of(scene));
    let frame = stock.as_ref().map_or_else(|| Frame::of(scene), |stock| Frame::around(stock.extent()));
    let depths = Depths::of(scene);
    let legend = legend::Legend::new(scene, stock.as_ref(), &frame, &depths, shown);
    let mut canvas = Canvas::new(Frame::WIDTH, legend.bottom());
    canvas.title(&scene.title);
    canvas.open("id=\"drawing\"");
    let mut room = OccupiedSpace::new(frame.area());
    let hidden = match &stock {
        None => draw_scene(&mut canvas, scene, &frame, &depths, shown, &mut room),
        Some(stock) => {
            stock.draw(&mut canvas, &frame, "stock");
            Vec::new()
        }
    };
    symbols::draw_findings(&mut canvas, scene, &frame, &mut room, legend.listed);
    canvas.close();
    canvas.cover([[0.0, frame.area()[1][1]], [Frame::WIDTH, legend.bottom()]]);
    legend.draw(&mut canvas, &hidden);
    canvas.finish()
}

/// Draws the drawing and the moves of a scene. Returns the numbers of the cutting order for which there is no room.
fn draw_scene(
    canvas: &mut Canvas,
    scene: &Scene,
    frame: &Frame,
    depths: &Depths,
    shown: VisibleParts,
    room: &mut OccupiedSpace,
) -> Vec<u32> {
    symbols::draw_below_moves(canvas, scene, frame, room);
    let cuts: Vec<_> = scene.paths.iter().map(moves::cuts).collect();
    for (path, cuts) in scene.paths.iter().zip(&cuts) {
        moves::draw_kerf(canvas, path, cuts, &frame.of_path(path), depths);
    }
    for path in &scene.paths {
        let place = frame.of_path(path);
        symbols::reserve_symbols(path, &place, room);
        if shown.texts {
            symbols::draw_texts(canvas, path, &place, room);
        }
    }
    let mut hidden = Vec::new();
    for (path, cuts) in scene.paths.iter().zip(&cuts) {
        let place = frame.of_path(path);
        moves::draw(canvas, path, cuts, &place, depths, shown);
        hidden.extend(symbols::draw_above_moves(canvas, path, &place, shown, room));
    }
    hidden
}
