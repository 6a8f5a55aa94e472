//! Kinds of faults with their parameters.

use periplus_params::{ParamValues, Table, params};

params! {
    /// Time window of a fault.
    pub struct FaultWindowParams {
        /// Start of the fault. In an event it counts from the event.
        #[param("from", unit("s"), min(0.0))]
        from_s: f64 = 0,
        /// End of the fault (default: never). In an event it counts from the event.
        #[param("until", unit("s"), min(0.0))]
        until_s: Option<f64>,
    }
}

params! {
    /// Messages are lost independently of each other.
    #[table(DROPOUT, "dropout")]
    pub struct DropoutParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic.
        #[param("topic", required())]
        topic: String,
        /// Probability that a message is lost.
        #[param("probability", within(0.0, 1.0))]
        probability: f64 = 1,
    }
}

params! {
    /// Messages are lost in bursts: the two-state Markov chain of Gilbert and Elliott.
    #[table(PACKET_LOSS, "packet_loss")]
    pub struct PacketLossParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic.
        #[param("topic", required())]
        topic: String,
        /// Probability at each message of a change from the good to the bad state.
        #[param("enter", within(0.0, 1.0))]
        enter_probability: f64 = 0.05,
        /// Probability at each message of a change from the bad to the good state; its inverse is the mean length of
        /// a burst in messages.
        #[param("leave", within(0.0, 1.0))]
        leave_probability: f64 = 0.25,
        /// Probability of a loss in the good state.
        #[param("loss_in_good", within(0.0, 1.0))]
        good_loss_probability: f64 = 0,
        /// Probability of a loss in the bad state.
        #[param("loss_in_bad", within(0.0, 1.0))]
        bad_loss_probability: f64 = 1,
    }
}

params! {
    /// Messages arrive late, in their order. Their stamps do not change.
    #[table(LATENCY, "latency")]
    pub struct LatencyParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic.
        #[param("topic", required())]
        topic: String,
        /// Mean of the delay.
        #[param("mean", unit("s"), within(0.0, 60.0))]
        mean_s: f64 = 0.1,
        /// Standard deviation of the delay, which is at least 0.
        #[param("jitter", unit("s"), within(0.0, 60.0))]
        jitter_s: f64 = 0,
    }
}

params! {
    /// Messages arrive twice.
    #[table(DUPLICATE, "duplicate")]
    pub struct DuplicateParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic.
        #[param("topic", required())]
        topic: String,
        /// Probability that a message arrives twice.
        #[param("probability", within(0.0, 1.0))]
        probability: f64 = 1,
    }
}

params! {
    /// Messages are overtaken by later ones.
    #[table(REORDER, "reorder")]
    pub struct ReorderParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic.
        #[param("topic", required())]
        topic: String,
        /// Probability that a message is held back.
        #[param("probability", within(0.0, 1.0))]
        probability: f64 = 0.2,
        /// Time for which it is held back; more than the period of the topic.
        #[param("delay", unit("s"), within(0.0, 60.0))]
        delay_s: f64 = 0.25,
    }
}

params! {
    /// The clock of a device jumps: the stamps of its messages are shifted.
    #[table(CLOCK_JUMP, "clock_jump")]
    pub struct ClockJumpParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic with stamped messages, transforms or `/clock`.
        #[param("topic", required())]
        topic: String,
        /// Shift of the stamps; negative into the past.
        #[param("offset", unit("s"), within(-3600.0, 3600.0))]
        offset_s: f64 = 1,
    }
}

params! {
    /// Readings have a bias and a wrong scale: the ranges of a lidar or sonar \[m\], the yaw rate of an IMU
    /// \[rad/s\], the forward speed of an odometry message \[m/s\].
    #[table(BIAS, "bias")]
    pub struct BiasParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic with `LaserScan`, `Range`, `Imu` or `Odometry`.
        #[param("topic", required())]
        topic: String,
        /// Bias, added after the scale, in the unit of the reading.
        #[param("offset")]
        offset: f64 = 0,
        /// Factor of the reading.
        #[param("scale")]
        scale_factor: f64 = 1,
    }
}

params! {
    /// Readings have bursts of white noise, on the quantities of `bias`.
    #[table(NOISE, "noise")]
    pub struct NoiseParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic with `LaserScan`, `Range`, `Imu` or `Odometry`.
        #[param("topic", required())]
        topic: String,
        /// Standard deviation of the noise, in the unit of the reading.
        #[param("stddev", min(0.0))]
        stddev: f64 = 0.1,
        /// Period that has one burst at a random time; 0 for noise without a pause.
        #[param("period", unit("s"), min(0.0))]
        period_s: f64 = 0,
        /// Length of a burst.
        #[param("length", unit("s"), min(0.0))]
        length_s: f64 = 0.5,
    }
}

params! {
    /// Readings are stuck: the first message of the time window is repeated with new stamps.
    #[table(STUCK_READINGS, "stuck_readings")]
    pub struct StuckReadingsParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic.
        #[param("topic", required())]
        topic: String,
    }
}

params! {
    /// A sector of a lidar is blocked, as by dirt or a part of the robot.
    #[table(BLOCKED_SECTOR, "blocked_sector")]
    pub struct BlockedSectorParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic with `LaserScan`.
        #[param("topic", required())]
        topic: String,
        /// First angle of the sector in the frame of the lidar.
        #[param("min_angle", unit("rad"))]
        min_angle_rad: f64 = -0.5,
        /// Last angle of the sector.
        #[param("max_angle", unit("rad"))]
        max_angle_rad: f64 = 0.5,
        /// Range that the sector reads (default: infinite, as without a return).
        #[param("range", unit("m"), min(0.0))]
        range_m: Option<f64>,
    }
}

params! {
    /// The yaw rate of an IMU drifts: its bias has a constant rate and a random walk.
    #[table(GYRO_DRIFT, "gyro_drift")]
    pub struct GyroDriftParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic with `Imu`.
        #[param("topic", required())]
        topic: String,
        /// Bias at the start.
        #[param("bias", unit("rad/s"))]
        bias_rad_s: f64 = 0,
        /// Rate of the bias.
        #[param("rate", unit("rad/s^2"))]
        rate_rad_s2: f64 = 0,
        /// Standard deviation of the random walk of the bias after one second.
        #[param("random_walk", unit("rad/s/sqrt(s)"), min(0.0))]
        random_walk_rad_s_per_sqrt_s: f64 = 0.01,
    }
}

params! {
    /// A lidar looks through a model, as through glass.
    #[table(GLASS, "glass")]
    pub struct GlassParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic with `LaserScan`.
        #[param("topic", required())]
        topic: String,
        /// Name of the model.
        #[param("model", required())]
        model: String,
    }
}

params! {
    /// A model reflects the beams of a lidar, as a mirror does: the lidar measures the length of the whole path.
    #[table(MIRROR, "mirror")]
    pub struct MirrorParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Topic with `LaserScan`.
        #[param("topic", required())]
        topic: String,
        /// Name of the model.
        #[param("model", required())]
        model: String,
    }
}

params! {
    /// Wheels slip: the friction of links of the robot is limited.
    #[table(WHEEL_SLIP, "wheel_slip")]
    pub struct WheelSlipParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Links of the wheels.
        #[param("links", required())]
        links: Vec<String>,
        /// Maximum coefficient of friction.
        #[param("friction", min(0.0))]
        friction_ratio: f64 = 0.01,
    }
}

params! {
    /// The robot drives on a slippery floor: the friction of all its links is limited.
    #[table(LOW_FRICTION, "low_friction")]
    pub struct LowFrictionParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Maximum coefficient of friction.
        #[param("friction", min(0.0))]
        friction_ratio: f64 = 0.02,
    }
}

params! {
    /// Wheels are stuck: their joints are held in place.
    #[table(STUCK_WHEEL, "stuck_wheel")]
    pub struct StuckWheelParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Joints of the wheels.
        #[param("joints", required())]
        joints: Vec<String>,
    }
}

params! {
    /// The robot is carried to another pose, at rest, at the start of the window.
    #[table(KIDNAP, "kidnap")]
    pub struct KidnapParams {
        /// Time window, of which only the start counts.
        #[shared]
        window: FaultWindowParams,
        /// Pose in the world: x \[m\], y \[m\], and yaw \[rad\] (default: the present yaw).
        #[param("pose", required())]
        pose: Vec<f64>,
    }
}

params! {
    /// A model is moved at the start of the window, and back at its end.
    #[table(MOVED_MODEL, "moved_model")]
    pub struct MovedModelParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Name of the model.
        #[param("model", required())]
        model: String,
        /// Pose in the world: x \[m\], y \[m\], and yaw \[rad\] (default: the present yaw).
        #[param("pose", required())]
        pose: Vec<f64>,
    }
}

params! {
    /// A box appears, and disappears at the end of the window.
    #[table(BOX, "box")]
    pub struct BoxParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Name of the model.
        #[param("name")]
        name: String = "fault_box",
        /// Pose of the middle on the floor: x \[m\], y \[m\], and yaw \[rad\] (default 0).
        #[param("pose", required())]
        pose: Vec<f64>,
        /// Sizes along x, y and z.
        #[param("size", unit("m"), above(0.0))]
        size_m: Vec<f64> = "0.5 0.5 0.8",
    }
}

params! {
    /// A door is closed: a leaf connects two points until the end of the window.
    #[table(CLOSED_DOOR, "closed_door")]
    pub struct ClosedDoorParams {
        /// Time window.
        #[shared]
        window: FaultWindowParams,
        /// Name of the model.
        #[param("name")]
        name: String = "fault_door",
        /// One side of the frame: x, y.
        #[param("left", unit("m"), required())]
        left_m: Vec<f64>,
        /// The other side of the frame: x, y.
        #[param("right", unit("m"), required())]
        right_m: Vec<f64>,
        /// Height of the leaf.
        #[param("height", unit("m"), above(0.0))]
        height_m: f64 = 2,
        /// Thickness of the leaf.
        #[param("thickness", unit("m"), above(0.0))]
        thickness_m: f64 = 0.05,
    }
}

/// Declares the enumeration of all kinds with their tables.
macro_rules! fault_kinds {
    ($($(#[doc = $doc:literal])+ $variant:ident($params:ident, $table:ident)),+ $(,)?) => {
        /// Kind of a fault with its parameters.
        #[derive(Clone, Debug, PartialEq)]
        pub enum FaultKind {
            $($(#[doc = $doc])+ $variant($params)),+
        }

        impl FaultKind {
            /// Tables of the parameters of all kinds; the name of a table is the word of its kind.
            #[must_use]
            pub fn tables() -> &'static [&'static Table] {
                static TABLES: &[&Table] = &[$(&$table),+];
                TABLES
            }

            /// Converts values of one of the tables; `None` for another table.
            #[must_use]
            pub fn from_values(values: &ParamValues) -> Option<Self> {
                $(if values.table().name == $table.name {
                    return Some(Self::$variant($params::from_values(values)));
                })+
                None
            }

            /// Values of the parameters.
            #[must_use]
            pub fn to_values(&self) -> ParamValues {
                match self {
                    $(Self::$variant(params) => params.to_values()),+
                }
            }

            /// Word of the kind, such as `dropout`.
            #[must_use]
            pub fn word(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $table.name),+
                }
            }

            pub(crate) fn window(&self) -> &FaultWindowParams {
                match self {
                    $(Self::$variant(params) => &params.window),+
                }
            }
        }
    };
}

fault_kinds! {
    /// Independent loss of messages.
    Dropout(DropoutParams, DROPOUT),
    /// Loss of messages in bursts.
    PacketLoss(PacketLossParams, PACKET_LOSS),
    /// Late messages.
    Latency(LatencyParams, LATENCY),
    /// Messages that arrive twice.
    Duplicate(DuplicateParams, DUPLICATE),
    /// Messages in a wrong order.
    Reorder(ReorderParams, REORDER),
    /// Shifted stamps.
    ClockJump(ClockJumpParams, CLOCK_JUMP),
    /// Bias and scale of readings.
    Bias(BiasParams, BIAS),
    /// Bursts of noise.
    Noise(NoiseParams, NOISE),
    /// Repeated readings.
    StuckReadings(StuckReadingsParams, STUCK_READINGS),
    /// Blocked sector of a lidar.
    BlockedSector(BlockedSectorParams, BLOCKED_SECTOR),
    /// Drift of a gyroscope.
    GyroDrift(GyroDriftParams, GYRO_DRIFT),
    /// Glass in front of a lidar.
    Glass(GlassParams, GLASS),
    /// Mirror in front of a lidar.
    Mirror(MirrorParams, MIRROR),
    /// Slip of wheels.
    WheelSlip(WheelSlipParams, WHEEL_SLIP),
    /// Slippery floor.
    LowFriction(LowFrictionParams, LOW_FRICTION),
    /// Stuck wheels.
    StuckWheel(StuckWheelParams, STUCK_WHEEL),
    /// Kidnapped robot.
    Kidnap(KidnapParams, KIDNAP),
    /// Moved furniture.
    MovedModel(MovedModelParams, MOVED_MODEL),
    /// Box that appears.
    Box(BoxParams, BOX),
    /// Closed door.
    ClosedDoor(ClosedDoorParams, CLOSED_DOOR),
}

impl FaultKind {
    /// Topic whose messages it changes; `None` for faults of wheels and of the world.
    #[must_use]
    pub fn topic(&self) -> Option<&str> {
        match self {
            Self::Dropout(it) => Some(&it.topic),
            Self::PacketLoss(it) => Some(&it.topic),
            Self::Latency(it) => Some(&it.topic),
            Self::Duplicate(it) => Some(&it.topic),
            Self::Reorder(it) => Some(&it.topic),
            Self::ClockJump(it) => Some(&it.topic),
            Self::Bias(it) => Some(&it.topic),
            Self::Noise(it) => Some(&it.topic),
            Self::StuckReadings(it) => Some(&it.topic),
            Self::BlockedSector(it) => Some(&it.topic),
            Self::GyroDrift(it) => Some(&it.topic),
            Self::Glass(it) => Some(&it.topic),
            Self::Mirror(it) => Some(&it.topic),
            Self::WheelSlip(_)
            | Self::LowFriction(_)
            | Self::StuckWheel(_)
            | Self::Kidnap(_)
            | Self::MovedModel(_)
            | Self::Box(_)
            | Self::ClosedDoor(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_have_no_faults() {
        for table in FaultKind::tables() {
            assert_eq!(table.faults(), [""; 0], "{}", table.name);
            assert!(!table.doc.is_empty());
        }
    }
}
