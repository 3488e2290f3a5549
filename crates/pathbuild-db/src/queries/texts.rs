//! Which element each parameter text belongs to.

use pathbuild_path::AssignedText;

use super::rereading::read_layers;
use crate::db::Db;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// The texts of a drawing's paths, and what each belongs to. The drawing is read once more for that.
#[salsa::tracked]
pub fn assigned_texts(db: &dyn Db, file: SourceFile) -> Vec<AssignedText> {
    let language = Settings::get(db).language(db);
    let drawing = read_layers(db, file, &|layer| language.path_pattern.is_layer(layer));
    pathbuild_path::assigned_texts(&drawing, language)
}
