//! `unique_identifier_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/unique_identifier_msgs`
//! instead.

crate::message! {
    /// A number that is used once.
    "unique_identifier_msgs/msg/UUID" "RIHS01_1b8e8aca958cbea28fe6ef60bf6c19b683c97a9ef60bb34752067d0f2f7ab437"
    UUID {
        /// uuid
        uuid: [u8; 16],
    }
}
