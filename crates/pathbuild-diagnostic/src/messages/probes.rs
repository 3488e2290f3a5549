//! Z-probes. (PB601 to PB607)

messages! {
    /// Somebody has measured.
    VALUES_PRESENT: ProbeValuesPresent {
        en: "{name} holds measured values that belong to other probes",
        de: "{name} enthält gemessene Werte, die zu anderen Probes gehören",
        help_en: "the drawing's probes have changed since; nothing was written for this path. Measure anew and use --force",
        help_de: "die Probes der Zeichnung haben sich seither geändert; für diesen Pfad wurde nichts geschrieben. Neu messen und --force verwenden",
    }
}
