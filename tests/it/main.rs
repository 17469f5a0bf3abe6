mod missions;
