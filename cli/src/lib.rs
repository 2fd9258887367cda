//! The binary pelea: the only composition root.
