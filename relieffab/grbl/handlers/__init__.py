"""URL handlers for pyserial, which looks here for `protocol_<scheme>` modules."""
