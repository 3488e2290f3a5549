//! Drawings as lines of text, turned into DXF.
