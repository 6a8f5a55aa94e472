//! Errors of other methods on the same logs: mean translation over all relations \[m\].

/// Errors of other methods on a log.
pub(crate) struct Peers {
    pub(crate) log: &'static str,
    /// Cartographer: Hess et al. 2016, "Real-Time Loop Closure in 2D LIDAR SLAM".
    pub(crate) cartographer: Option<f64>,
    /// Graph mapping: Kümmerle et al. 2009, "On Measuring the Accuracy of SLAM Algorithms".
    pub(crate) graph: Option<f64>,
    /// A particle filter of 50 particles (GMapping), from the same.
    pub(crate) rbpf: Option<f64>,
    /// GMapping with 30 particles, measured on the same log: all, loops.
    pub(crate) gmapping: Option<(f64, Option<f64>)>,
    /// Karto as `slam_toolbox` has it, with its defaults, measured on the same log: all, loops.
    pub(crate) karto: Option<(f64, Option<f64>)>,
}

const NONE: Peers =
    Peers { log: "", cartographer: None, graph: None, rbpf: None, gmapping: None, karto: None };

/// All that is known.
pub(crate) const PEERS: [Peers; 6] = [
    Peers {
        log: "intel-full",
        cartographer: Some(0.0229),
        graph: Some(0.031),
        rbpf: Some(0.070),
        ..NONE
    },
    Peers {
        log: "aces-full",
        cartographer: Some(0.0375),
        graph: Some(0.044),
        rbpf: Some(0.060),
        ..NONE
    },
    Peers { log: "intel", gmapping: Some((0.0495, None)), karto: Some((0.0785, None)), ..NONE },
    Peers {
        log: "csail-full",
        gmapping: Some((0.076, Some(0.076))),
        karto: Some((0.089, Some(0.247))),
        ..NONE
    },
    Peers {
        log: "aces",
        gmapping: Some((0.272, Some(1.34))),
        karto: Some((0.081, Some(0.284))),
        ..NONE
    },
    Peers { log: "edmonton", karto: Some((0.071, Some(0.313))), ..NONE },
];

/// Errors of other methods on a log.
pub(crate) fn of(log: &str) -> &'static Peers {
    PEERS.iter().find(|it| it.log == log).unwrap_or(&NONE)
}
