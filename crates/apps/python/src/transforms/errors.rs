//! Exceptions with the messages of tf2.

use periplus::tf::{LookupError, LookupErrorKind};
use pyo3::create_exception;
use pyo3::exceptions::PyLookupError;
use pyo3::prelude::*;

create_exception!(
    periplus,
    TransformError,
    PyLookupError,
    "There is no such transform. The text is that of tf2.\n\n\
     >>> import periplus\n\
     >>> issubclass(periplus.TransformError, LookupError)\n\
     True"
);
create_exception!(
    periplus,
    TransformLookupError,
    TransformError,
    "A frame does not exist (``LookupException`` of tf2).\n\n\
     >>> import periplus\n\
     >>> issubclass(periplus.TransformLookupError, periplus.TransformError)\n\
     True"
);
create_exception!(
    periplus,
    TransformConnectivityError,
    TransformError,
    "Two frames are in different trees (``ConnectivityException`` of tf2).\n\n\
     >>> import periplus\n\
     >>> issubclass(periplus.TransformConnectivityError, periplus.TransformError)\n\
     True"
);
create_exception!(
    periplus,
    TransformExtrapolationError,
    TransformError,
    "There are no samples at that time (``ExtrapolationException`` of tf2).\n\n\
     >>> import periplus\n\
     >>> issubclass(periplus.TransformExtrapolationError, periplus.TransformError)\n\
     True"
);
create_exception!(
    periplus,
    TransformArgumentError,
    TransformError,
    "The name of a frame is empty or begins with a slash (``InvalidArgumentException`` of tf2).\n\n\
     >>> import periplus\n\
     >>> issubclass(periplus.TransformArgumentError, periplus.TransformError)\n\
     True"
);

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("TransformError", py.get_type::<TransformError>())?;
    module.add("TransformLookupError", py.get_type::<TransformLookupError>())?;
    module.add("TransformConnectivityError", py.get_type::<TransformConnectivityError>())?;
    module.add("TransformExtrapolationError", py.get_type::<TransformExtrapolationError>())?;
    module.add("TransformArgumentError", py.get_type::<TransformArgumentError>())
}

/// The exception of an error.
pub(super) fn transform_error(error: &LookupError) -> PyErr {
    let text = error.message.clone();
    match error.kind {
        LookupErrorKind::Lookup => TransformLookupError::new_err(text),
        LookupErrorKind::Connectivity => TransformConnectivityError::new_err(text),
        LookupErrorKind::NoDataForExtrapolation
        | LookupErrorKind::Forward
        | LookupErrorKind::Backward => TransformExtrapolationError::new_err(text),
        LookupErrorKind::InvalidArgument => TransformArgumentError::new_err(text),
    }
}
