//! Messages and loads of the comparison, and the pairs of programs.

use periplus_msgs::Message;
use periplus_msgs::geometry_msgs::PointStamped;
use periplus_msgs::sensor_msgs::{LaserScan, PointCloud2, PointField};
use periplus_msgs::std_msgs::Header;

use super::peer::Side;

/// A message type; each begins with a header whose stamp is the time of publication.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// 640 by 480 points of 32 bytes: 9.83 MB.
    Cloud,
    /// 360 rays: 2.9 kB.
    Scan,
    /// 48 bytes.
    Small,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Cloud => "cloud",
            Self::Scan => "scan",
            Self::Small => "small",
        }
    }

    pub(super) fn dds_type(self) -> &'static str {
        match self {
            Self::Cloud => "sensor_msgs::msg::dds_::PointCloud2_",
            Self::Scan => "sensor_msgs::msg::dds_::LaserScan_",
            Self::Small => "geometry_msgs::msg::dds_::PointStamped_",
        }
    }

    pub(super) fn of_dds_type(name: &str) -> Option<Self> {
        [Self::Cloud, Self::Scan, Self::Small].into_iter().find(|kind| kind.dds_type() == name)
    }

    /// Returns a message as CDR.
    pub(super) fn template(self) -> Vec<u8> {
        let encoded = match self {
            Self::Cloud => cloud().to_cdr(),
            Self::Scan => scan().to_cdr(),
            Self::Small => PointStamped { header: header(), ..PointStamped::default() }.to_cdr(),
        };
        encoded.unwrap_or_default()
    }
}

fn header() -> Header {
    Header { frame_id: "sensor".to_owned(), ..Header::default() }
}

fn cloud() -> PointCloud2 {
    let field = |(name, offset): (&str, u32)| PointField {
        name: name.to_owned(),
        offset,
        datatype: PointField::FLOAT32,
        count: 1,
    };
    PointCloud2 {
        header: header(),
        height: 480,
        width: 640,
        fields: [("x", 0), ("y", 4), ("z", 8), ("rgb", 16)].map(field).into(),
        point_step: 32,
        row_step: 32 * 640,
        data: vec![7; 640 * 480 * 32],
        is_dense: true,
        ..PointCloud2::default()
    }
}

fn scan() -> LaserScan {
    let (ranges, intensities) = (vec![1.5; 360], vec![40.0; 360]);
    LaserScan { header: header(), ranges, intensities, range_max: 12.0, ..LaserScan::default() }
}

/// A number of messages at a rate.
pub(super) struct Load {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) count: u32,
    pub(super) period_us: u32,
    /// Queue depth of both endpoints.
    pub(super) depth: u32,
    /// Receive buffer of the peers' sockets \[bytes\]; none for their default.
    pub(super) buffer: Option<u32>,
    /// True if samples are so large that Cyclone's fragment size and the transports of Fast DDS
    /// matter.
    pub(super) is_large: bool,
}

const LARGE_S: u32 = 7;
const SMALL_S: u32 = 5;

pub(super) const LOADS: [Load; 5] = [
    Load {
        name: "cloud, default buffers",
        kind: Kind::Cloud,
        count: LARGE_S * 30,
        period_us: 33_333,
        depth: 5,
        buffer: None,
        is_large: true,
    },
    Load {
        name: "cloud, 4 MB buffers",
        kind: Kind::Cloud,
        count: LARGE_S * 30,
        period_us: 33_333,
        depth: 5,
        buffer: Some(4 << 20),
        is_large: true,
    },
    Load {
        name: "scan",
        kind: Kind::Scan,
        count: SMALL_S * 100,
        period_us: 10_000,
        depth: 10,
        buffer: None,
        is_large: false,
    },
    Load {
        name: "small, keep 10",
        kind: Kind::Small,
        count: SMALL_S * 1000,
        period_us: 1_000,
        depth: 10,
        buffer: None,
        is_large: false,
    },
    Load {
        name: "small, keep 1000",
        kind: Kind::Small,
        count: SMALL_S * 1000,
        period_us: 1_000,
        depth: 1000,
        buffer: None,
        is_large: false,
    },
];

/// Sender and receiver.
pub(super) struct Pair {
    pub(super) from: Side,
    pub(super) to: Side,
    only_large: bool,
}

impl Pair {
    pub(super) fn is_for(&self, load: &Load) -> bool {
        load.is_large || !self.only_large
    }
}

const fn pair(from: Side, to: Side) -> Pair {
    Pair { from, to, only_large: false }
}

const fn large(from: Side, to: Side) -> Pair {
    Pair { from, to, only_large: true }
}

pub(super) const PAIRS: [Pair; 9] = [
    pair(Side::Ours, Side::Fast),
    pair(Side::Ours, Side::Cyclone),
    pair(Side::Fast, Side::Ours),
    pair(Side::Cyclone, Side::Ours),
    pair(Side::Ours, Side::Ours),
    pair(Side::FastByUdp, Side::FastByUdp),
    pair(Side::Fast, Side::Fast),
    pair(Side::Cyclone, Side::Cyclone),
    large(Side::CycloneAsOurs, Side::CycloneAsOurs),
];
