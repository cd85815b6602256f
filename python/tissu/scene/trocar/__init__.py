"""Trocars of a scene: port, device, tools, hand, limits; what a device and its coupling may be."""
