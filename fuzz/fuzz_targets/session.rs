//! Any bytes as a session of the mapper, with a checksum that is right: a reason, or a map that is
//! written as it was read and takes another scan.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_geometry::{LaserScan2, Pose2, ScannerMounting};
use periplus_slam::{Settings, Slam};

fuzz_target!(|bytes: &[u8]| {
    // The last four bytes are the checksum of the rest.
    let end = bytes.len().saturating_sub(4);
    let mut whole = bytes[..end].to_vec();
    let sum = crc32fast::hash(&whole);
    whole.extend_from_slice(&sum.to_le_bytes());
    // Work in the background of hostile graphs is not a question of reading.
    let settings = Settings { slices_per_scan: 0, ..Settings::default() };
    let Ok(mut slam) = Slam::resume(&whole, settings.clone()) else { return };
    let again = slam.save();
    let read = Slam::resume(&again, settings).expect("what was written can be read");
    assert_eq!(read.save(), again);
    let _ = slam.to_g2o();
    let _ = slam.trajectory();
    let scan = LaserScan2 {
        time_ns: 1_000_000_000,
        mounting: ScannerMounting::upright(Pose2::IDENTITY),
        angle_min_rad: -1.5,
        angle_increment_rad: 0.05,
        time_increment_s: 0.0,
        range_min_m: 0.1,
        range_max_m: 20.0,
        ranges_m: (0..60).map(|beam| 2.0 + 0.05 * beam as f32).collect(),
    };
    let _ = slam.add_scan(&scan, Some(Pose2::new(0.5, 0.0, 0.1)));
});
