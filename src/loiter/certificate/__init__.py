"""Certificates of single maneuvers: the conditions of the maximum principle, checked one by one."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from loiter.certificate.entry_certificate import Certificate, certify
    from loiter.certificate.slot_certificate import ArrivalCertificate, SlotCertificate, certify_arrival, certify_slot

__all__ = ["ArrivalCertificate", "Certificate", "SlotCertificate", "certify", "certify_arrival", "certify_slot"]


def __getattr__(name: str) -> Any:
    # Imported on first use: the certificate needs the kernel, which the oracle must not load.
    if name in __all__:
        from loiter.certificate import entry_certificate, slot_certificate

        return getattr(entry_certificate if name in ("Certificate", "certify") else slot_certificate, name)
    raise AttributeError(f"module 'loiter.certificate' has no attribute {name!r}")
