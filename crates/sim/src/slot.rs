//! One vehicle of the world, with its serial ports and the ground stations on them. The connections
//! are kept here because they outlive a reboot, which replaces the [`Autopilot`].

use mavlink::dialects::ardupilotmega::MavMessage;

use super::Serial;
use super::autopilot::Autopilot;
use super::autopilot::telemetry;
use super::port::{Port, Serials};
use super::signing::Signing;

/// A vehicle and its connections.
#[derive(Debug, Clone)]
pub(super) struct VehicleSlot {
    pub(super) autopilot: Autopilot,
    pub(super) serials: Serials,
    /// The connections, with their numbers in the world.
    pub(super) ports: Vec<(u64, Port)>,
}

impl VehicleSlot {
    pub(super) fn new(autopilot: Autopilot) -> Self {
        Self {
            serials: Serials::booted(&autopilot.vehicle, Signing::default(), Box::default()),
            autopilot,
            ports: Vec::new(),
        }
    }

    pub(super) fn require_signatures(&mut self) {
        self.serials.signing.be_strict();
    }

    pub(super) fn connect(&mut self, number: u64, serial: Serial) {
        if !self.is_anybody_on(serial) {
            self.serials.link_mut(serial).schedule.resume();
        }
        let port = Port::new(self.autopilot.vehicle.system, serial);
        self.ports.push((number, port));
    }

    /// Removes a port; returns whether there was one with this number.
    pub(super) fn disconnect(&mut self, number: u64) -> bool {
        let place = self.place(number);
        place.map(|place| self.ports.remove(place)).is_some()
    }

    pub(super) fn is_open(&self, number: u64) -> bool {
        self.place(number)
            .and_then(|place| self.ports.get(place))
            .is_some_and(|(_, port)| port.open)
    }

    pub(super) fn receive(&mut self, number: u64, bytes: &[u8]) {
        if let Some(place) = self.place(number) {
            self.with_port(place, |port, autopilot, serials| {
                port.receive(autopilot, serials, bytes)
            });
        }
    }

    pub(super) fn take_output(&mut self, number: u64, into: &mut Vec<u8>) {
        let place = self.place(number);
        if let Some((_, port)) = place.and_then(|place| self.ports.get_mut(place)) {
            port.take_output(into);
        }
    }

    /// Advances by one step and sends the messages that are due.
    pub(super) fn step(&mut self) {
        if self.autopilot.vehicle.boot.awaits_client()
            && !self.ports.iter().any(|(_, port)| port.open)
        {
            return;
        }
        for place in 0..self.ports.len() {
            if self.ports[place].1.is_pause() {
                self.with_port(place, Port::end_of_burst);
            }
        }
        self.autopilot.step();
        self.print();
        if !self.autopilot.vehicle.outbox.is_empty() {
            let said = std::mem::take(&mut self.autopilot.vehicle.outbox);
            self.tell(&said, None);
        }
        self.announce();
        self.stream();
        for (_, port) in self.ports.iter_mut().filter(|(_, port)| port.open) {
            port.list(&self.autopilot, &mut self.serials.signing);
            port.transfer(&mut self.autopilot, &mut self.serials);
        }
        if self.autopilot.take_reboot() {
            self.reboot();
        }
    }

    /// Sends the announcements of operator control, and the requests for it.
    fn announce(&mut self) {
        let now = self.autopilot.vehicle.uptime();
        let Some(operator) = &mut self.autopilot.operator else {
            return;
        };
        for news in operator.step(now) {
            for (_, port) in self.ports.iter_mut().filter(|(_, port)| port.open) {
                port.answer(&news, &mut self.serials.signing);
            }
        }
    }

    /// Sends the text that the boot prints on the first serial port.
    fn print(&mut self) {
        for text in self.autopilot.vehicle.boot.take_console() {
            for (_, port) in &mut self.ports {
                if port.open && port.serial == Serial::Zero {
                    port.print(text.as_ref());
                }
            }
        }
    }

    /// Sends the due messages on each serial port with a client.
    fn stream(&mut self) {
        let now = self.autopilot.vehicle.uptime();
        for serial in Serial::ALL {
            if !self.is_anybody_on(serial) {
                continue;
            }
            let Serials { links, signing, .. } = &mut self.serials;
            links[serial.index()].schedule.each_due(now, |id| {
                if self.autopilot.vehicle.boot.holds_back(id) {
                    return;
                }
                let message = if id == telemetry::TRAFFIC {
                    self.autopilot.vehicle.next_traffic(serial)
                } else {
                    telemetry::message(id, &self.autopilot)
                };
                let Some(message) = message else {
                    return;
                };
                for (_, port) in &mut self.ports {
                    if port.open && port.serial == serial {
                        port.stream(&message, signing);
                    }
                }
            });
        }
    }

    fn reboot(&mut self) {
        for (_, port) in &mut self.ports {
            port.open = false;
        }
        let mut signing = std::mem::take(&mut self.serials.signing);
        signing.reboot();
        let transfers = std::mem::take(&mut *self.serials.transfers).rebooted();
        self.serials = Serials::booted(&self.autopilot.vehicle, signing, Box::new(transfers));
    }

    fn place(&self, number: u64) -> Option<usize> {
        self.ports.iter().position(|(own, _)| *own == number)
    }

    fn is_anybody_on(&self, serial: Serial) -> bool {
        self.ports
            .iter()
            .any(|(_, port)| port.open && port.serial == serial)
    }

    /// Calls `work` with an open port, and sends its broadcast messages to the other ports.
    fn with_port(
        &mut self,
        place: usize,
        work: impl FnOnce(&mut Port, &mut Autopilot, &mut Serials) -> Vec<MavMessage>,
    ) {
        let Some((_, own)) = self.ports.get_mut(place).filter(|(_, port)| port.open) else {
            return;
        };
        let said = work(own, &mut self.autopilot, &mut self.serials);
        self.tell(&said, Some(place));
    }

    /// Sends messages to every ground station, except one that already has them.
    fn tell(&mut self, said: &[MavMessage], except: Option<usize>) {
        for (place, (_, port)) in self.ports.iter_mut().enumerate() {
            if Some(place) != except && port.open {
                port.broadcast(said, &mut self.serials);
            }
        }
    }
}
