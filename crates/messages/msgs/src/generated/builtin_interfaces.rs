//! `builtin_interfaces`. Made by `cargo xtask codegen`; edit the texts in `interfaces/builtin_interfaces`
//! instead.

crate::message! {
    /// A span of time.
    "builtin_interfaces/msg/Duration" "RIHS01_e8d009f659816f758b75334ee1a9ca5b5c0b859843261f14c7f937349599d93b"
    Duration {
        /// Whole seconds; negative spans round down.
        sec: i32,
        /// The rest, always forwards; ns below one second.
        nanosec: u32,
    }
}

crate::message! {
    /// A moment, on the clock of the sender: the machine's or the simulation's.
    "builtin_interfaces/msg/Time" "RIHS01_b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197"
    Time {
        /// Whole seconds; 0 is 1970 or the start of the simulation.
        sec: i32,
        /// The rest; ns below one second.
        nanosec: u32,
    }
}
