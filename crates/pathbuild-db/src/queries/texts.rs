//! Assigns parameter texts to elements.

use pathbuild_path::AssignedText;

use super::rereading::read_layers;
use crate::db::Db;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// The texts of a drawing's paths with the element of each. The drawing is read again for that.
#[salsa::tracked]
pub fn assigned_texts(db: &dyn Db, file: SourceFile) -> Vec<AssignedText> {
    let language = Settings::get(db).language(db);
    let drawing = read_layers(db, file, &|layer| language.path_pattern.is_layer(layer));
    pathbuild_path::assigned_texts(&drawing, language)
}
