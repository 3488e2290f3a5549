//! The reader, rule by rule: for each, one input just inside and one just outside. (spec/10-drawing.md; reference/dxf.md section 4)

mod entities;
mod support;
