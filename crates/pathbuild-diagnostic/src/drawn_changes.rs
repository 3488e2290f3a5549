//! Texts that describe the changes in a drawing and why they change the moves of a path. (book: program/comparing)

use crate::words::words;

words! {
    /// Name of a start marker. A path has only one, so it needs no position.
    START: "start marker", "Anfangsmarke";
    /// Name of an end marker. A path has only one, so it needs no position.
    END: "end marker", "Endmarke";
    /// Name of a turn marker.
    TURN: "turn marker at {point}", "Wendemarke bei {point}";
    /// Name of several turn markers.
    TURNS: "{count} turn markers, the first at {point}", "{count} Wendemarken, die erste bei {point}";
    /// Name of a Z-probe.
    PROBE: "Z-probe at {point}", "Z-Probe bei {point}";
    /// Name of several Z-probes.
    PROBES: "{count} Z-probes, the first at {point}", "{count} Z-Proben, die erste bei {point}";
    /// Name of a circle.
    CIRCLE: "circle at {point}", "Kreis bei {point}";
    /// Name of several circles.
    CIRCLES: "{count} circles, the first at {point}", "{count} Kreise, der erste bei {point}";
    /// Name of a line.
    LINE: "line from {point} to {end}", "Linie von {point} bis {end}";
    /// Name of several lines.
    LINES: "{count} lines, the first at {point}", "{count} Linien, die erste bei {point}";
    /// Name of an arc.
    ARC: "arc from {point} to {end}", "Bogen von {point} bis {end}";
    /// Name of several arcs.
    ARCS: "{count} arcs, the first at {point}", "{count} Bögen, der erste bei {point}";
    /// The element is new.
    ADDED: "{what}: added", "{what}: dazugekommen";
    /// The element is gone.
    REMOVED: "{what}: removed", "{what}: weggefallen";
    /// The element is at another place.
    MOVED: "{what}: moved by {by} mm", "{what}: um {by} mm verschoben";
    /// One end of the element is at another place.
    END_MOVED: "{what}: one end moved by {by} mm", "{what}: ein Ende um {by} mm verschoben";
    /// The element has another shape.
    RESHAPED: "{what}: runs differently", "{what}: anderer Verlauf";
    /// A circle has another diameter.
    DIAMETER: "{what}: diameter {was} became {now}", "{what}: aus Durchmesser {was} wurde {now}";
    /// An arc has another radius.
    RADIUS: "{what}: radius {was} became {now}", "{what}: aus Radius {was} wurde {now}";
    /// The element has another line type.
    LINE_TYPE: "{what}: line type changed from {was} to {now}", "{what}: Linientyp von {was} in {now} geändert";
    /// Parameters in the element's text differ.
    TEXT: "{what}: text {was} became {now}", "{what}: aus dem Text {was} wurde {now}";
    /// The element's text has further parameters.
    TEXT_ADDED: "{what}: text {now} added", "{what}: Text {now} dazugekommen";
    /// The element's text has fewer parameters.
    TEXT_REMOVED: "{what}: text {was} removed", "{what}: Text {was} weggefallen";
    /// A variable has another value.
    VARIABLE: "variable {name}: {was} became {now}", "Variable {name}: aus {was} wurde {now}";
    /// A key of the configuration that the path uses has another value.
    SETTING: "{name} in pathbuild.toml: {was} became {now}", "{name} in pathbuild.toml: aus {was} wurde {now}";
    /// The value of a variable or a key that is not set.
    NOT_SET: "not set", "nicht gesetzt";
    /// An embedded path has changed. Its own changes are listed below.
    EMBEDDED: "embedded path {path} changed", "eingebetteter Pfad {path} geändert";
    /// An embedded path has changed; its own changes are already listed above.
    EMBEDDED_AGAIN: "embedded path {path} changed, as above", "eingebetteter Pfad {path} geändert, wie oben";
    /// The elements are the same, but in another order in the file.
    REORDERED: "the same elements, in another order in the file", "dieselben Elemente, in anderer Reihenfolge in der Datei";
}
