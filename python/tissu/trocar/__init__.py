"""The active trocar: kinematics, the law of a tick, devices, and the controller that holds them.

A scene without `trocars:` imports none of it.
"""
