// Provides: names of physical quantities, so that a signature states what goes in and comes out. SI throughout.
#define Kelvin float
#define Metre float
#define PerMetre float
#define Radian float
#define Ratio float            // dimensionless, 0 to 1
#define Radiance float         // in the sensor's band [W m-2 sr-1]
#define Irradiance float       // in the sensor's band [W m-2]
#define Direction vec3         // unit vector, pointing away from the surface; x east, y north, z up
