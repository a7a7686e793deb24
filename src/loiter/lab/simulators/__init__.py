"""Simulated aircraft, gusts and sensors for flights of guidance laws."""
