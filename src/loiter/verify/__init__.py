"""Witnesses that do not believe the kernel, and certificates that spare anyone believing it."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from loiter.verify.certificate import Certificate, certify

__all__ = ["Certificate", "certify"]


def __getattr__(name: str) -> Any:
    # The certificate needs the kernel, which the oracle beside it must not load.
    if name in __all__:
        from loiter.verify import certificate

        return getattr(certificate, name)
    raise AttributeError(f"module 'loiter.verify' has no attribute {name!r}")
