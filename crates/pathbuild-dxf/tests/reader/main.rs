//! The reader, rule by rule: for each, one input just inside and one just outside. (book: reference/dxf)

mod binary;
mod block_layers;
mod blocks;
mod compatible;
mod curves;
mod encoding;
mod entities;
mod in_a_row;
mod layer_records;
mod layers;
mod limits;
mod lines;
mod mirrored;
mod noted;
mod numbers;
mod plain_text;
mod polylines;
mod structure;
mod support;
mod texts;
mod units;
mod visibility;
