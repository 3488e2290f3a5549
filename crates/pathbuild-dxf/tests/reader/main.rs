//! Tests the reader rule by rule, with one input that just complies and one that just does not. (book: reference/dxf)

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
