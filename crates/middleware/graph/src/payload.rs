//! Content of a message as a Rust value or as bytes.

use std::any::Any;
use std::sync::{Arc, OnceLock};

use periplus_msgs::{DecodeError, EncodeError, Message};

type Erased = Arc<dyn Any + Send + Sync>;

/// Content of a message shared by all its readers. The other form is created once, on first use.
pub(crate) enum Payload {
    /// Published as a value.
    Typed {
        message: Erased,
        encode: fn(&(dyn Any + Send + Sync)) -> Result<Vec<u8>, EncodeError>,
        cdr: OnceLock<Result<Vec<u8>, EncodeError>>,
    },
    /// Published as CDR.
    Raw { cdr: Vec<u8>, message: OnceLock<Result<Erased, DecodeError>> },
}

impl Payload {
    pub(crate) fn typed<T: Message>(message: Arc<T>) -> Self {
        Self::Typed { message, encode: encode::<T>, cdr: OnceLock::new() }
    }

    pub(crate) fn raw(cdr: Vec<u8>) -> Self {
        Self::Raw { cdr, message: OnceLock::new() }
    }

    /// The value. All readers of a topic use one Rust type, so the first use decides the type.
    pub(crate) fn message<T: Message>(&self) -> Result<Arc<T>, DecodeError> {
        let erased = match self {
            Self::Typed { message, .. } => message,
            Self::Raw { cdr, message } => {
                let decode = || T::decode_cdr(cdr).map(|message| Arc::new(message) as Erased);
                message.get_or_init(decode).as_ref().map_err(Clone::clone)?
            }
        };
        if let Ok(message) = erased.clone().downcast::<T>() {
            return Ok(message);
        }
        // Two Rust types for one ROS type occur only in tests.
        let bytes = self.cdr().map_err(|error| DecodeError {
            problem: periplus_msgs::Problem::Bound { count: error.count, limit: error.limit },
            path: error.field,
            offset: 0,
        })?;
        T::decode_cdr(bytes).map(Arc::new)
    }

    /// The bytes, with the four-byte encapsulation header.
    pub(crate) fn cdr(&self) -> Result<&[u8], EncodeError> {
        match self {
            Self::Typed { message, encode, cdr } => {
                let bytes = cdr.get_or_init(|| encode(message.as_ref()));
                bytes.as_ref().map(Vec::as_slice).map_err(Clone::clone)
            }
            Self::Raw { cdr, .. } => Ok(cdr),
        }
    }
}

fn encode<T: Message>(message: &(dyn Any + Send + Sync)) -> Result<Vec<u8>, EncodeError> {
    let message = message.downcast_ref::<T>().expect("created with the message");
    message.to_cdr()
}
