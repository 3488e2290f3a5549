//! Pictures of findings, each of which shows a detail of a drawing. (book: reference/output)

use std::collections::BTreeSet;
use std::str::FromStr;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::is_drawing;
use pathbuild_diagnostic::{Code, Diagnostic, Point, Value};
use pathbuild_view::{
    FindingPlace, MESSAGES_IN_PROGRAM_COORDINATES, Places, Scene, cutout_svg, has_stock, stock_cutout_svg,
};
use pathbuild_workspace::Workspace;
use pathbuild_workspace::files::write_error;
use pathbuild_workspace::findings::{Findings, Fingerprint};
use pathbuild_workspace::session::Session;

/// Maximum number of findings that get a picture.
const MAX_PICTURES: usize = 1000;

/// Total size of pictures in bytes at which no more are drawn. Pictures with thousands of elements each could otherwise add up to
/// gigabytes.
const MAX_PICTURE_BYTES: usize = 256 << 20;

/// Returns one picture per finding as SVG; `None` if the finding has no place in a drawing, or if the limits are reached.
pub(crate) fn pictures<'d>(workspace: &Workspace, diagnostics: &'d [Diagnostic]) -> Vec<Option<String>> {
    let mut files: Vec<&Utf8Path> =
        diagnostics.iter().take(MAX_PICTURES).filter_map(|diagnostic| drawing(diagnostic)).collect();
    files.sort_unstable();
    files.dedup();
    let scenes = Session::new(workspace).drawn_scenes(&files);
    let places = scenes.iter().zip(&files).map(|(scene, file)| Some(scene.as_ref()?.places(file.as_str())));
    let places: Vec<Option<Places<'_>>> = places.collect();
    let drawn = |diagnostic: &Diagnostic| -> Option<String> {
        let file = files.binary_search(&drawing(diagnostic)?).ok()?;
        let spot = finding_place(diagnostic, places[file].as_ref())?;
        Some(cutout_svg(scenes[file].as_ref()?, &spot, workspace.lang()))
    };
    let session = Session::new(workspace);
    let mut known: Option<StockScene<'_>> = None;
    let mut stock = |index: usize, diagnostic: &'d Diagnostic| -> Option<String> {
        let place = drawing_and_path_of_part(diagnostic)?;
        if known.as_ref().is_none_or(|(known, _)| *known != place) {
            let scene = session.scene_of(place.0, place.1).filter(has_stock);
            known = Some((place, scene));
        }
        let scene = known.as_ref()?.1.as_ref()?;
        let has_corners = diagnostic.code() == Code::UnreachableCorner;
        let spot = if MESSAGES_IN_PROGRAM_COORDINATES.contains(&diagnostic.message) {
            spot_in_program(diagnostic, scene, place.0)
        } else {
            finding_place(diagnostic, None)
        };
        Some(stock_cutout_svg(scene, &spot?, has_corners, index))
    };
    let mut bytes = 0;
    let picture = |(index, diagnostic): (usize, &'d Diagnostic)| {
        drawing(diagnostic).filter(|_| index < MAX_PICTURES && bytes < MAX_PICTURE_BYTES)?;
        let picture = stock(index, diagnostic).or_else(|| drawn(diagnostic))?;
        bytes += picture.len();
        Some(picture)
    };
    diagnostics.iter().enumerate().map(picture).collect()
}

/// The file of a drawing, the name of a path in it, and the path's scene if the path cuts anything.
type StockScene<'d> = ((&'d Utf8Path, &'d str), Option<Scene>);

/// Returns the drawing and the path of a finding about a finished part, because such findings are shown in pictures of the stock; `None`
/// for all other findings.
fn drawing_and_path_of_part(diagnostic: &Diagnostic) -> Option<(&Utf8Path, &str)> {
    let is_about_part = matches!(
        diagnostic.code(),
        Code::GougedPart
            | Code::GougedNeighbour
            | Code::LeftoverAtPart
            | Code::UnreachableCorner
            | Code::LoosePart
            | Code::BarCutAway
            | Code::DisplacedPath
            | Code::CutInLooseWaste
    );
    Some((drawing(diagnostic)?, diagnostic.path.as_deref()?)).filter(|_| is_about_part)
}

/// Returns the drawing that contains the place of a finding.
fn drawing(diagnostic: &Diagnostic) -> Option<&Utf8Path> {
    diagnostic.place.point?;
    let file = diagnostic.file.as_deref()?;
    is_drawing(file).then_some(file)
}

/// Distance in mm along each axis up to which two points count as the same place.
const SAME_PLACE: f64 = 1e-6;

/// Returns the place of a finding, with further places mentioned in its message and notes.
fn finding_place(diagnostic: &Diagnostic, places: Option<&Places<'_>>) -> Option<FindingPlace> {
    let at = places.and_then(|places| places.of(diagnostic)).or(diagnostic.place.point.map(pair))?;
    let notes = diagnostic.notes.iter().flat_map(|note| &note.arguments);
    let is_centre = |name: &str| name == "centre";
    let own = diagnostic.arguments.iter().filter(|(name, _)| !is_centre(name));
    let points = own.chain(notes).flat_map(|(_, value)| value.points()).map(pair);
    let is_elsewhere = |point: &[f64; 2]| (0..2).any(|axis| (point[axis] - at[axis]).abs() > SAME_PLACE);
    let mut related: Vec<[f64; 2]> = points.filter(is_elsewhere).collect();
    related.dedup();
    let circle = match (diagnostic.argument("centre"), diagnostic.argument("diameter")) {
        (Some(Value::Point(centre)), Some(Value::Number(diameter))) => {
            Some((pair(*centre), diameter.0 / 2.0))
        }
        _ => None,
    };
    Some(FindingPlace { at, related, circle, is_error: diagnostic.is_error() })
}

/// Returns the place in the drawing of a finding whose message has coordinates of the program: the element that causes the damage, and the damaged
/// spot as a related point. `file` is the drawing of the scene. For an embedded drawing, the coordinates are those of the embedding path's program,
/// so only the element is marked.
fn spot_in_program(diagnostic: &Diagnostic, scene: &Scene, file: &Utf8Path) -> Option<FindingPlace> {
    let zero = scene.paths.first()?.zero;
    // A neighbour's place is where the outline of the part begins. The outline is drawn anyway, and a detail that includes that point would show a
    // small cut into the part at a smaller scale.
    let is_marked = diagnostic.trace.is_empty() && diagnostic.code() != Code::GougedNeighbour;
    let related = match diagnostic.argument("place") {
        Some(Value::Point(place)) if is_marked => vec![[0, 1].map(|axis| pair(*place)[axis] + zero[axis])],
        _ => Vec::new(),
    };
    let at = scene.places(file.as_str()).of(diagnostic).or(diagnostic.place.point.map(pair))?;
    Some(FindingPlace { at, related, circle: None, is_error: diagnostic.is_error() })
}

fn pair(point: Point) -> [f64; 2] {
    [point.x.0, point.y.0]
}

/// The result of writing the pictures of findings into a directory.
#[derive(Default)]
pub(crate) struct WrittenPictures {
    /// The error that stopped the writing.
    pub(crate) problems: Vec<Diagnostic>,
    /// Names of the pictures in the directory that this run has not written, in ascending order.
    pub(crate) others: Vec<String>,
}

/// Writes the pictures of findings into a directory, and stops at the first file that cannot be written. The same finding has the same file name
/// in every run.
pub(crate) fn write(workspace: &Workspace, directory: &Utf8Path, findings: &Findings) -> WrittenPictures {
    let directory = workspace.working_directory.join(directory);
    let images = pictures(workspace, &findings.diagnostics);
    let names = Fingerprint::of(&findings.diagnostics).into_iter().zip(&findings.diagnostics);
    let mut written = BTreeSet::new();
    let mut problems = Vec::new();
    for (picture, (fingerprint, diagnostic)) in images.into_iter().zip(names) {
        let Some(picture) = picture else { continue };
        let name = name(diagnostic, fingerprint);
        let file = directory.join(&name);
        if let Err(reason) = workspace.system.write(&file, picture.as_bytes()) {
            problems.push(write_error(&file, reason));
            break;
        }
        written.insert(name.into_string());
    }
    let listing = workspace.system.list(&directory).ok();
    let names = listing.iter().flat_map(|listing| listing.files.iter());
    let others = names.filter(|name| is_name(name) && !written.contains(*name));
    let mut others: Vec<String> = others.map(str::to_owned).collect();
    others.sort_unstable();
    WrittenPictures { problems, others }
}

/// Whether a file has the name of a finding's picture.
fn is_name(file: &str) -> bool {
    let mut parts = file.strip_suffix(".svg").unwrap_or_default().rsplit('-');
    let is_fingerprint = |part: &str| part.len() == 8 && part.bytes().all(|byte| byte.is_ascii_hexdigit());
    let is_code = |part: &str| Code::from_str(part).is_ok();
    parts.next().is_some_and(is_fingerprint) && parts.next().is_some_and(is_code) && parts.next().is_some()
}

/// Maximum length in bytes of the part of a picture's name that is taken from the drawing.
const MAX_STEM_BYTES: usize = 80;

/// Returns the file name of a finding's picture, such as `2050.1P-PB401-3f2a9c0d.svg`.
fn name(diagnostic: &Diagnostic, fingerprint: Fingerprint) -> Utf8PathBuf {
    let stem = diagnostic.file.as_deref().and_then(Utf8Path::file_stem).unwrap_or_default();
    let is_plain = |letter: char| letter.is_alphanumeric() || matches!(letter, '.' | '_' | ' ' | '~');
    let stem: String = stem.chars().map(|letter| if is_plain(letter) { letter } else { '-' }).collect();
    let stem = &stem[..stem.floor_char_boundary(MAX_STEM_BYTES)];
    format!("{stem}-{}-{}.svg", diagnostic.code(), &fingerprint.to_string()[..8]).into()
}
