"""Certificates of single maneuvers: the conditions of the maximum principle, checked one by one."""

from typing import TYPE_CHECKING

from loiter.lazy import lazy_names

if TYPE_CHECKING:
    from loiter.certificate.entry_certificate import Certificate, certify
    from loiter.certificate.slot_certificate import ArrivalCertificate, SlotCertificate, certify_arrival, certify_slot

__all__ = ["ArrivalCertificate", "Certificate", "SlotCertificate", "certify", "certify_arrival", "certify_slot"]


# Imported on first use: the certificate needs the kernel, which the oracle must not load.
__getattr__ = lazy_names(
    __name__,
    {
        "ArrivalCertificate": "slot_certificate",
        "Certificate": "entry_certificate",
        "SlotCertificate": "slot_certificate",
        "certify": "entry_certificate",
        "certify_arrival": "slot_certificate",
        "certify_slot": "slot_certificate",
    },
)
